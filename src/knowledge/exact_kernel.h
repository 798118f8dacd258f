#pragma once

#include <lore/core/channels.h>
#include <lore/core/lanes.h>

#include <cstddef>
#include <cstdint>

// The inner loops of the exact index, compiled once per instruction set (cmake: lore_kernel). Plain structs and
// pointers only: see core/lanes.h for why.
namespace lore::exact {

/// A window's summary: the sums of each continuous channel over each half of its steps, quantised.
inline constexpr int summary_size  = 2 * continuous_count;
inline constexpr int summary_scale = 255;   ///< its largest number

/// What is derived from a configuration once (exact_index.cpp explains the bounds).
struct Shape {
    int window_length;
    int words;            ///< 64-bit words that hold the binary channels of a window
    int first_half;       ///< steps of the first half
    float scales[2];      ///< of the sums of each half
    int tables;
    int most_differing;   ///< bits
    float squared_threshold;
};

/// All that the bounds need of a feature, 16 bytes.
struct Digest {
    std::uint8_t summary[summary_size];
    std::int32_t feature;
};
static_assert(sizeof(Digest) == 16);

/// The features whose hashed bits fall into one slot of a table: entries start .. start + count - 1. An entry is a
/// feature's whole pattern, then its Digest, so that a bucket is read in one sweep.
struct Bucket {
    std::uint32_t start;
    std::uint32_t count;
};
/// In 64-bit words.
LORE_INLINE constexpr int entry_size(int pattern_words) {
    return pattern_words + static_cast<int>(sizeof(Digest) / sizeof(std::uint64_t));
}

/// A set of features as the kernel reads it.
struct View {
    Shape shape;
    std::uint64_t const* masks;    ///< [table][word]: the bits that a table hashes
    Bucket const* buckets;         ///< [table][2^slot_bits]
    int slot_bits;
    std::uint64_t const* entries;  ///< [entry][entry_size]
    float const* values;           ///< [feature][step][6]
    std::int32_t const* limits;    ///< [differing bits]: largest summary distance of a match
};

/// A window as it is compared with features. What it points to belongs to the caller.
struct Query {
    std::uint64_t const* words;    ///< its pattern
    float const* values;
};

/// A feature that may lie within the threshold.
struct Candidate {
    Digest digest;
    std::int32_t differing;        ///< bits
};

struct Nearest {
    std::int32_t feature;          ///< -1: none
    float squared_distance;
};

struct Kernel {
    /// The pattern of a window: its binary channels, step after step.
    void (*pack)(Shape const&, std::uint16_t const* bits, std::uint64_t* words);
    void (*summarize)(Shape const&, float const* values, Digest&);
    /// Writes every feature whose pattern differs in few enough bits, some of them more than once, and returns how
    /// many. `out` has room for all features of all tables and one more.
    int (*within)(View const&, std::uint64_t const* words, Candidate* out);
    /// Writes those that the summaries do not rule out, and returns how many. `out` has room for all and one more, and
    /// may be `in`.
    int (*promising)(View const&, Digest const& window, Candidate const* in, int count, Candidate* out);
    /// The nearest of the candidates if it is within the threshold; among equals the lowest number.
    Nearest (*nearest)(View const&, Query const&, Candidate const*, int count);
};

namespace isa_baseline { Kernel kernel(); }
namespace isa_v3 { Kernel kernel(); }
namespace isa_v4 { Kernel kernel(); }

} // namespace lore::exact
