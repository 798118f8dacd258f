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
/// Numbers of a key: those of a summary, of which the last is in one with the first.
inline constexpr int key_size = 11;
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

/// What is derived from a configuration once (exact_shape.h explains the bounds).
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
    int code_size;          ///< bytes of a window's codes (exact_codes.h); 0 without continuous channels
    float code_slack;       ///< what rounding in float may add to how far a window's codes lie from it
    SumBound summary_bound, key_bound;
};

/// All that the bounds need of a feature: one vector of 16 bytes.
struct Digest {
    std::uint8_t summary[summary_size];
    std::int32_t feature;
};
static_assert(sizeof(Digest) == 16);

/// To pass over most features that share some bits with a window without looking at them: sums of the continuous
/// channels, quantized, and how many bits are set (255: so many or more).
struct Key {
    std::uint8_t sums[key_size];
    std::uint8_t ones;
    std::int32_t feature;
};
static_assert(sizeof(Key) == 16);

/// A key's numbers, its sums and then its ones, in parts of four: one lane of 32 bits each.
inline constexpr int key_parts = (key_size + 1) / 4;
static_assert(key_parts * 4 == key_size + 1 && offsetof(Key, feature) == key_size + 1);

/// Keys that are neighbors in one bucket. So many are looked at together, or passed over together by their range.
inline constexpr int key_group = 16;

/// The numbers of so many keys, or the ends of so many ranges: a vector has the same part of several.
struct KeyNumbers {
    std::uint8_t of[key_parts][key_group][4];
};

/// Four cache lines.
struct KeyGroup {
    KeyNumbers numbers;
    std::int32_t features[key_group];
};
static_assert(sizeof(KeyGroup) == key_group * sizeof(Key));

/// The features whose hashed bits fall into one slot of a table: places start .. start + count - 1.
struct Bucket {
    std::uint32_t start;
    std::uint32_t count;
};

/// From the pattern of one feature to that of the next, in 64-bit words: none lies in more cache lines than it must.
LORE_INLINE constexpr int pattern_room(int words) {
    constexpr int line = 8;
    return words <= 2 ? words : words <= 4 ? 4 : (words + line - 1) / line * line;
}

/// A feature's pattern, then its Digest, in 64-bit words: of a final set.
LORE_INLINE constexpr int record_size(int pattern_words) {
    return pattern_words + static_cast<int>(sizeof(Digest) / sizeof(std::uint64_t));
}

/// Hash tables of a final set: each feature is in one bucket of every table.
struct Tables {
    std::uint64_t const* masks;   ///< [table][word]: the bits that a table hashes
    Bucket const* buckets;        ///< [table][2^slot_bits]
    int slot_bits;
};

/// Keys of all features, and the hash table that they are in: each feature is in one bucket.
struct KeyedTable {
    KeyGroup const* keys;   ///< [place / key_group], there at place % key_group
    /// [group / key_group], there at group % key_group, of buckets with more than key_group places, which begin at
    /// whole groups: between these, number for number, lie the group's keys.
    KeyNumbers const *least, *most;
    std::uint64_t const* mask = nullptr;   ///< [word]: the bits that it hashes
    Bucket const* buckets = nullptr;       ///< [2^slot_bits]; null: there is no hash table
    int slot_bits = 0;
};

/// Keys of one bucket that are looked through before what was found among them is compared, where one bucket holds all.
inline constexpr std::uint32_t keys_at_once = 2048;

/// A set of features by their keys, as the kernel reads it: one that still grows, or a final one whose shares of
/// keys_at_once are in falling order of worth.
struct KeyedView {
    Shape shape;
    KeyedTable const* tables;        ///< growing_tables of them; of a final one, one without a hash table
    std::uint64_t const* patterns;   ///< [feature][pattern_room]
    std::uint8_t const* codes;       ///< [feature][code_size]
};

/// A final set with hash tables. A bucket's places are those of `records`, so that it is read in one sweep.
struct FixedView {
    Shape shape;
    Tables tables;
    std::uint64_t const* records;   ///< [place][record_size]
    float const* values;            ///< [feature][step][continuous channel]
    std::int32_t const* limits;     ///< [differing bits]: largest summary distance of a match
};

/// A window as it is asked for among features by their keys. What it points to belongs to the caller.
struct Question {
    std::uint64_t const* words;   ///< its pattern
    std::uint8_t const* codes;
    Key key;   ///< of no feature
};

/// A window as it is compared with features of a final set.
struct Query {
    std::uint64_t const* words;   ///< its pattern
    float const* values;
};

/// A bucket that a search has to look through, and the number of its table.
struct Visit {
    Bucket bucket;
    std::int32_t table;
    std::uint32_t slot;   ///< of the table
};

/// Tables of a set that grows.
LORE_INLINE constexpr int growing_tables(Shape const& shape) { return shape.tables + (shape.halves ? 2 : 0); }

/// A feature that its key, and then its bits, do not rule out.
struct Promising {
    std::int32_t feature;
    std::int32_t apart;       ///< distance of the keys' sums
    std::int32_t differing;   ///< bits, once its pattern was looked at
};

/// A feature that may be the nearest, as far as codes tell.
struct Finalist {
    std::int32_t feature;
    std::int32_t differing;   ///< bits
    float least, most;        ///< between these its squared distance lies
};

/// What a search found: for windows with this hash.
struct Recent {
    std::uint64_t slot;
    std::int32_t feature;   ///< -1: none
};

/// Memory that a search by keys needs.
struct Scratch {
    Visit* visits;   ///< one a table: growing_tables
    /// Room for the largest bucket and spare_keys more: features, and how far apart the sums of their keys are.
    std::int32_t *features, *apart;
    std::int32_t* groups;   ///< room for the groups of the largest bucket and spare_keys more
    /// [2^recent_bits]: what windows like this one matched last, or -1; it is tried first, because the nearer a match
    /// is that is already known, the less there is to look at. Alike: their bits, or their keys where bits are not
    /// hashed, have the same hash. Null: nothing is remembered.
    std::int32_t* recent;
    Recent* last;           ///< of the last search with this memory
    Promising* promising;   ///< room for the largest bucket
    Finalist* finalists;    ///< room for as many as growing_tables of the largest buckets and one more
};
inline constexpr int recent_bits = 16;
inline constexpr int spare_keys = key_group;   ///< that a vector writes beyond the last one

/// Which features a search by keys is for.
struct Wanted {
    float bound;             ///< those whose squared distance is not greater
    std::int32_t features;   ///< with smaller numbers
};

/// A search by keys: what is asked, and how many finalists it found.
struct Search {
    Question question;
    Wanted wanted;
    Scratch scratch;
    int finalists;
};
/// So many are done together: each waits for memory most of the time, and while it does the others go on.
inline constexpr int searches_together = 12;

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
    /// Writes a window's pattern and codes, and returns its key, which is of no feature.
    Key (*describe)(Shape const&, std::uint16_t const* bits, float const* values, std::uint64_t* words,
                    std::uint8_t* codes);
    /// Writes those that may be the nearest of the wanted ones to Scratch::finalists, each once. The nearest is among
    /// them if any of the wanted ones is not beyond the bound. At most searches_together; each has memory of its own,
    /// but for Scratch::recent.
    void (*closest)(KeyedView const&, Search*, int count);
    /// The same of one among some places of a ranked set, from the first of a share on.
    void (*closest_among)(KeyedView const&, Search&, Bucket places);
    /// What the continuous values of two windows add to their squared distance.
    float (*distance)(Shape const&, float const* a, float const* b);
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

Kernel kernel_of(Isa);

}   // namespace lore::exact
