#pragma once

#include <lore/core/isa.h>
#include <lore/core/lanes.h>

#include <cstddef>
#include <cstdint>

// The inner loops of the exact index, compiled once per instruction set (cmake: lore_kernel). Plain structs and
// pointers only: see core/lanes.h for why.
namespace lore::exact {

/// Numbers of a window's summary, quantized sums of its continuous channels: with up to 12 channels those of each
/// channel over each of 12 / channels blocks of steps (two halves for six channels), with more those of channel c, over
/// all steps, in number c mod 12. What is not needed is 0.
inline constexpr int summary_size = 12;
inline constexpr int summary_scale = 255;   ///< a summary's largest number
/// Numbers of a key: the sum of continuous channel c over all steps is in number c mod 7.
inline constexpr int key_size = 7;
inline constexpr int most_continuous = 80;   ///< channels: all that a world may have

/// Says how far quantized sums of two windows may lie from each other: at most slope * left + offset, if the squares of
/// the windows' differences add up to `left`.
struct SumBound {
    float slope, offset;
    LORE_INLINE std::int32_t largest(float left) const {
        float const most = slope * (left > 0 ? left : 0.0f) + offset;
        return most < 2e9f ? static_cast<std::int32_t>(most) : 2000000000;
    }
};

/// What is derived from a configuration once (exact_index.cpp explains the bounds).
struct Shape {
    int window_length;
    int step_words;                       ///< 16-bit words that hold the bits of a step
    int binary, continuous;               ///< channels of each kind
    int words;                            ///< 64-bit words that hold the binary channels of a window
    int blocks;                           ///< of steps, each with sums of its own
    int block_starts[summary_size + 1];   ///< steps; block b ends where the next one starts
    float scales[summary_size];           ///< of a summary's numbers
    float key_scales[key_size];           ///< of a key's
    /// One a block of bits, or one if bits are too few to tell features apart: then one bucket holds all.
    int tables;
    bool hashes;
    /// Whether a set that grows has, before those of the blocks, two tables of half the bits each: table 0 hashes the
    /// blocks of even number, table 1 those of odd number.
    bool halves;
    int most_differing;   ///< bits
    float squared_threshold;
    float relative_error;   ///< of a squared distance in float
    SumBound summary_bound, key_bound;
};

/// All that the bounds need of a feature: one vector of 16 bytes.
struct Digest {
    std::uint8_t summary[summary_size];
    std::int32_t feature;
};
static_assert(sizeof(Digest) == 16);

/// Less, to pass over most features that share their bits with a window without looking at them: sums of the continuous
/// channels over all steps, quantized, and how many bits are set (255: so many or more).
struct Key {
    std::uint8_t sums[key_size];
    std::uint8_t ones;
};
static_assert(sizeof(Key) == 8);

/// The features whose hashed bits fall into one slot of a table: places start .. start + count - 1.
struct Bucket {
    std::uint32_t start;
    std::uint32_t count;
};

/// A feature's pattern, then its Digest, in 64-bit words.
LORE_INLINE constexpr int record_size(int pattern_words) {
    return pattern_words + static_cast<int>(sizeof(Digest) / sizeof(std::uint64_t));
}

/// Hash tables: each feature is in one bucket of every table.
struct Tables {
    std::uint64_t const* masks;   ///< [table][word]: the bits that a table hashes
    Bucket const* buckets;        ///< [table][2^slot_bits]
    int slot_bits;
};

/// A set of features by their keys, as the kernel reads it: one that still grows, or a final one in falling order of
/// worth (RankedKeys). A bucket's places are those of `keys` and `numbers`.
struct KeyedView {
    Shape shape;
    Tables tables;
    Key const* keys;                ///< [place]
    std::int32_t const* numbers;    ///< [place]: the feature
    std::uint64_t const* records;   ///< [feature][record_size]
    float const* values;            ///< [feature][step][continuous channel]
};

/// A final one. A bucket's places are those of `records`, so that it is read in one sweep.
struct FixedView {
    Shape shape;
    Tables tables;
    std::uint64_t const* records;   ///< [place][record_size]
    float const* values;            ///< [feature][step][continuous channel]
    std::int32_t const* limits;     ///< [differing bits]: largest summary distance of a match
};

/// A window as it is compared with features. What it points to belongs to the caller.
struct Query {
    std::uint64_t const* words;   ///< its pattern
    float const* values;
};

/// A bucket that a search has to look through.
struct Visit {
    Bucket bucket;
    std::int32_t table;
};

/// Tables of a set that grows.
LORE_INLINE constexpr int growing_tables(Shape const& shape) { return shape.tables + (shape.halves ? 2 : 0); }

/// A feature that bits and sums do not rule out.
struct Promising {
    std::int32_t feature;
    std::int32_t differing;   ///< bits
    std::int32_t apart;       ///< distance of the summaries
};

/// Memory that a search by keys needs.
struct Scratch {
    Visit* visits;           ///< one a table: growing_tables
    std::int32_t* numbers;   ///< room for the largest bucket and spare_numbers more
    /// [2^recent_bits]: what windows like this one matched last, or -1; it is tried first, because the nearer a match
    /// is that is already known, the less there is to look at. Alike: their bits, or their keys where bits are not
    /// hashed, have the same hash.
    std::int32_t* recent;
    Promising* promising;   ///< room for the largest bucket
};
inline constexpr int recent_bits = 16;
inline constexpr int spare_numbers = 8;

/// A feature that may lie within the threshold.
struct Candidate {
    Digest digest;
    std::int32_t differing;   ///< bits
};

struct Nearest {
    std::int32_t feature;   ///< -1: none
    float squared_distance;
};

struct Kernel {
    /// The pattern of a window: its binary channels, step after step.
    void (*pack)(Shape const&, std::uint16_t const* bits, std::uint64_t* words);
    void (*summarize)(Shape const&, float const* values, Digest&);
    /// The same, and the key of a window with this pattern.
    Key (*summarize_with_key)(Shape const&, std::uint64_t const* words, float const* values, Digest&);
    /// The nearest within the threshold; among equals the lowest number.
    Nearest (*closest)(KeyedView const&, Query const&, Digest const&, Key const&, Scratch);
    /// The same among some places of a ranked set, if it is nearer than `best`; else `best`.
    Nearest (*closest_among)(KeyedView const&, Query const&, Digest const&, Key const&, Scratch, Bucket places,
                             Nearest best);
    /// Whether the pattern of any of these features differs in few enough bits.
    bool (*any_within)(KeyedView const&, std::uint64_t const* words, Bucket places);
    /// Writes every feature whose pattern differs in few enough bits, some of them more than once, and returns how
    /// many. `out` has room for all in the pattern's buckets and one more.
    int (*within)(FixedView const&, std::uint64_t const* words, Candidate* out);
    /// Writes those that the summaries do not rule out, and returns how many. `out` has room for all and one more, and
    /// may be `in`.
    int (*promising)(FixedView const&, Digest const& window, Candidate const* in, int count, Candidate* out);
    /// The nearest of the candidates if it is within the threshold; among equals the lowest number.
    Nearest (*nearest)(FixedView const&, Query const&, Candidate const*, int count);
};

LORE_KERNEL(Kernel kernel())

}   // namespace lore::exact
