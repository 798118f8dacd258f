#pragma once

#include <lore/core/channels.h>

#include <cstddef>
#include <cstdint>

// The inner loops of the exact index, compiled once per instruction set (cmake: lore_kernel). Plain structs and
// pointers only: see core/lanes.h for why.
namespace lore::exact {

/// One number of a summary; a window's summary are the sums of each continuous channel over each half of its steps.
inline constexpr int summary_size = 2 * continuous_count;

/// Largest quantised number of a summary: the squares of 12 differences still fit in 32 bits.
inline constexpr int summary_scale = 8191;

/// What is derived from a configuration once (exact_index.cpp explains the bounds).
struct Shape {
    int window_length;
    int words;            ///< 64-bit words that hold the binary channels of a window
    int first_half;       ///< steps of the first half
    float scales[2];      ///< of the sums of each half
    int value_stride;     ///< floats a window, a multiple of 16
    int tables;
    int most_differing;   ///< bits
    float squared_threshold;
    int record_lines;     ///< cache lines a record
    int next_offset;      ///< bytes from a record's start to its chain links
    int summary_offset;   ///< and to its summary
};

/// A set of features as the kernel reads it. A feature's record holds its bits, per table the next feature of its
/// chain (-1: none), and its summary.
struct View {
    Shape shape;
    std::uint64_t const* masks;    ///< [table][word]: the bits that a table hashes
    std::int32_t const* heads;     ///< [table][2^head_bits]
    int head_bits;
    std::byte const* records;
    float const* values;           ///< [feature][value_stride], padded with zeros
    std::int32_t const* limits;    ///< [differing bits]: largest summary distance of a match
};

/// A window made ready to be asked for; the arrays belong to the caller.
struct Query {
    std::uint64_t* words;
    float* values;                 ///< [value_stride]
    std::int16_t summary[summary_size];
};

/// A feature that may lie within the threshold.
struct Candidate {
    std::int32_t feature;
    std::int32_t differing;        ///< bits
};

struct Nearest {
    std::int32_t feature;          ///< -1: none
    float squared_distance;
};

struct Kernel {
    /// Fills `query` from a window's arrays.
    void (*prepare)(Shape const&, std::uint16_t const* bits, float const* values, Query& query);
    /// Writes every feature that the bounds do not rule out, each once, and returns how many. `candidates` has room for
    /// all features.
    int (*collect)(View const&, Query const&, Candidate* candidates);
    /// The nearest of the candidates if it is within the threshold; among equals the lowest number.
    Nearest (*nearest)(View const&, Query const&, Candidate const* candidates, int count);
};

namespace isa_baseline { Kernel kernel(); }
namespace isa_v3 { Kernel kernel(); }
namespace isa_v4 { Kernel kernel(); }

} // namespace lore::exact
