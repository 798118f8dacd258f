#pragma once

#include "exact_codes.h"
#include "exact_hash.h"
#include "exact_keys.h"

// How a kernel looks for the nearest feature by keys (exact_growing.cpp says why in this order).
namespace lore::exact::LORE_ISA_NAMESPACE {

namespace {

/// Groups of keys that are fetched before they are looked at: more would drive each other out of the nearest cache.
constexpr int fetched_at_most = 32;

/// What the root of a sum of codes' squares may be off by, of itself, and what follows from it.
constexpr float relative_code_error = 0x1p-19f;

/// One question to a set by its keys. As the search goes on, what was found leaves less and less room for a better one.
/// It is done in steps: each ends by fetching what the next one reads.
/// FixedWords: how many words a pattern has if it is known when compiling, else 0.
template <int FixedWords>
struct KeyedSearch {
    KeyedView const* view = nullptr;
    bool by_tables = false;   ///< else all places are looked through, by shares
    Question question{};
    Scratch scratch{};
    std::int32_t features = 0;    ///< that are wanted: those with smaller numbers
    float bound = 0;              ///< no match is beyond
    std::int32_t nearest = -1;    ///< the finalist that the bound comes from
    std::int32_t compared = -1;   ///< the feature that was compared before any bucket
    int finalists = 0;
    std::uint64_t recent_slot = 0;
    // Where it stands
    Bucket bucket{};                     ///< the one that is looked through
    KeyedTable const* table = nullptr;   ///< its table
    int visits = 0;                      ///< buckets seen before it
    int unseen = 0;                      ///< bits, at least, in which a feature differs that is in none of these
    int blocks[2] = {0, 0};              ///< seen, of the even and of the odd ones
    int of_halves[2] = {0, 0};           ///< 1: the half was seen
    Bucket rest{};                       ///< places that are left, if not by tables
    int groups = 0;                      ///< of its keys, in scratch, if it has_groups
    int candidates = 0;                  ///< in scratch

    LORE_INLINE Shape const& shape() const { return view->shape; }
    LORE_INLINE int word_count() const { return FixedWords > 0 ? FixedWords : shape().words; }
    LORE_INLINE std::uint64_t const* words() const { return question.words; }
    LORE_INLINE std::uint64_t const* pattern_of(std::int32_t feature) const {
        return view->patterns +
               static_cast<std::size_t>(feature) * static_cast<std::size_t>(pattern_room(word_count()));
    }
    LORE_INLINE std::uint8_t const* codes_of(std::int32_t feature) const {
        return view->codes + static_cast<std::size_t>(feature) * static_cast<std::size_t>(shape().code_size);
    }
    LORE_INLINE int differing_bits(std::uint64_t const* pattern) const {
        int differing = 0;
        for (int word = 0; word < word_count(); ++word)
            differing += __builtin_popcountll(words()[word] ^ pattern[word]);
        return differing;
    }
    /// Bits in which a better one may differ. In float first: a threshold may be beyond any int.
    LORE_INLINE int most_bits() const {
        return bound < static_cast<float>(shape().most_differing) ? static_cast<int>(bound) : shape().most_differing;
    }
    /// What the continuous channels of a better one that differs in so many bits may add to its squared distance.
    LORE_INLINE float left(int differing) const {
        return bound * (1 + shape().relative_error) - static_cast<float>(differing);
    }
    LORE_INLINE void compare(std::int32_t feature, int differing) {
        std::uint8_t const* const codes = codes_of(feature);
        float const apart = __builtin_sqrtf(code_squares(shape(), question.codes, codes)) * (1.0f / 255);
        float const rounding = rounding_of(shape(), question.codes) + rounding_of(shape(), codes);
        float const error = relative_code_error + shape().relative_error, bits = static_cast<float>(differing);
        float const nearer = apart * (1 - error) - rounding, near = nearer > 0 ? nearer : 0.0f;
        float const far = apart * (1 + error) + rounding;
        float const least = (near * near + bits) * (1 - error), most = (far * far + bits) * (1 + error);
        if (least > bound) return;
        scratch.finalists[finalists++] = {feature, differing, least, most};
        if (most >= bound && nearest >= 0) return;
        bound = most < bound ? most : bound;
        nearest = feature;
    }
    /// Those that the last bound leaves.
    LORE_INLINE int remaining() {
        int kept = 0;
        for (int i = 0; i < finalists; ++i)
            if (scratch.finalists[i].least <= bound) scratch.finalists[kept++] = scratch.finalists[i];
        return kept;
    }

    template <class T>
    LORE_INLINE static void fetch_lines(T const* from) {
        for (std::size_t at = 0; at < sizeof(T); at += 64)
            __builtin_prefetch(reinterpret_cast<std::uint8_t const*>(from) + at);
    }
    LORE_INLINE void fetch_buckets() const {
        for (int number = 0; number < growing_tables(shape()); ++number) {
            KeyedTable const& one = view->tables[number];
            std::uint64_t const slot = hash_slot(words(), one.mask, word_count(), one.slot_bits);
            __builtin_prefetch(one.buckets + slot);
            scratch.visits[number] = {{}, number, static_cast<std::uint32_t>(slot)};
        }
    }
    LORE_INLINE void fetch(std::int32_t feature) const {
        __builtin_prefetch(pattern_of(feature));
        for (int at = 0; at < shape().code_size; at += 64) __builtin_prefetch(codes_of(feature) + at);
    }

    /// Puts the window's buckets into the order in which they are visited: often one is enough. First those of the
    /// halves, then those of the blocks of the half whose buckets are smaller; of each the smaller ones first.
    LORE_INLINE void order_visits() {
        int const halves = shape().halves ? 2 : 0, tables = growing_tables(shape());
        std::uint32_t in_blocks[2] = {0, 0};
        for (int number = 0; number < tables; ++number) {
            Visit& visit = scratch.visits[number];
            visit.bucket = view->tables[number].buckets[visit.slot];
            if (number >= halves) in_blocks[number % 2] += visit.bucket.count;
        }
        int const smaller = in_blocks[1] < in_blocks[0];
        auto const rank = [&](Visit const& visit) {
            std::uint64_t const group = visit.table < halves ? 0 : halves > 0 && visit.table % 2 != smaller ? 2 : 1;
            return group << 32 | visit.bucket.count;
        };
        for (int number = 1; number < tables; ++number) {
            Visit const visit = scratch.visits[number];
            int place = number;
            for (; place > 0 && rank(scratch.visits[place - 1]) > rank(visit); --place)
                scratch.visits[place] = scratch.visits[place - 1];
            scratch.visits[place] = visit;
        }
        if (!by_tables) rest = scratch.visits[0].bucket;
        choose_first();
    }

    /// Such a feature has been seen in one of the first `visits` buckets.
    LORE_INLINE bool shares_a_block(std::uint64_t const* pattern) const {
        bool shares = false;
        for (int visit = 0; visit < visits; ++visit) {
            std::uint64_t const* const mask = view->tables[scratch.visits[visit].table].mask;
            std::uint64_t differing = 0;
            for (int word = 0; word < word_count(); ++word) differing |= (words()[word] ^ pattern[word]) & mask[word];
            shares |= differing == 0;
        }
        return shares;
    }

    LORE_INLINE bool has_groups() const { return bucket.count > 2 * key_group; }
    /// How far apart the keys of a feature may be that was not seen yet.
    LORE_INLINE std::int32_t largest() const { return shape().key_bound.largest(left(unseen)); }

    LORE_INLINE bool is_wanted(std::int32_t feature) const { return feature < features && feature != compared; }
    /// Whether a feature was not seen in another bucket and may be better; fills in the bits in which it differs.
    /// Without a branch: what comes out cannot be foretold.
    LORE_INLINE bool is_promising_and_new(Promising& one) const {
        std::uint64_t const* const pattern = pattern_of(one.feature);
        one.differing = differing_bits(pattern);
        return static_cast<int>(one.differing <= most_bits()) & static_cast<int>(is_promising(one)) &
               static_cast<int>(!shares_a_block(pattern));
    }
    LORE_INLINE bool is_promising(Promising const& one) const {
        return one.apart <= shape().key_bound.largest(left(one.differing));
    }

    // The steps, in this order; the last six for each bucket.

    /// What windows like this one matched last.
    LORE_INLINE void choose_first() {
        recent_slot = slot_of_recent();
        if (scratch.recent == nullptr) return;
        std::int32_t const recent =
            scratch.last->slot == recent_slot ? scratch.last->feature : scratch.recent[recent_slot];
        if (recent < 0 || recent >= features) return;
        compared = recent;
        fetch(recent);
    }
    LORE_INLINE void compare_first() {
        if (compared >= 0) compare(compared, differing_bits(pattern_of(compared)));
    }
    /// False: no feature that was not seen may be better.
    LORE_INLINE bool choose_bucket() {
        table = view->tables;
        if (!by_tables) {
            bucket = {rest.start, rest.count < keys_at_once ? rest.count : keys_at_once};
            rest = {rest.start + bucket.count, rest.count - bucket.count};
            if (bucket.count == 0) return false;
        } else {
            // A feature in none of the buckets seen so far differs in a bit of each half and block that they were of.
            unseen = 0;
            for (int half = 0; half < 2; ++half)
                unseen += blocks[half] > of_halves[half] ? blocks[half] : of_halves[half];
            if (visits == growing_tables(shape()) || bound < static_cast<float>(unseen)) return false;
            bucket = scratch.visits[visits].bucket;
            table += scratch.visits[visits].table;
        }
        if (has_groups()) {
            Bucket const all = groups_of_bucket();
            for (std::uint32_t group = 0; group < all.count && group < fetched_at_most; group += key_group) {
                fetch_lines(table->least + (all.start + group) / key_group);
                fetch_lines(table->most + (all.start + group) / key_group);
            }
        } else {
            for (std::uint32_t group = first_group(); group < end_group(); ++group) fetch_lines(table->keys + group);
        }
        return true;
    }
    LORE_INLINE std::uint32_t first_group() const { return bucket.start / key_group; }
    LORE_INLINE std::uint32_t end_group() const { return (bucket.start + bucket.count + key_group - 1) / key_group; }
    /// By number.
    LORE_INLINE Bucket groups_of_bucket() const { return {first_group(), end_group() - first_group()}; }
    LORE_INLINE void look_at_groups() {
        if (!has_groups()) return;
        Bucket const all = groups_of_bucket();
        NearKeys const near{question.key, most_bits(), largest()};
        groups = 0;
        for (std::uint32_t block = all.start / key_group; block * key_group < all.start + all.count; ++block)
            groups += near_keys(table->least[block], table->most[block], lanes_of(all, block), nullptr,
                                block * key_group, near, NearNames{scratch.groups, scratch.apart}.from(groups));
        for (int i = 0; i < groups && i < fetched_at_most; ++i) fetch_lines(table->keys + scratch.groups[i]);
    }
    LORE_INLINE int near_keys_of_bucket() const {
        NearKeys const near{question.key, most_bits(), largest()};
        int found = 0;
        auto const look_at = [&](std::uint32_t group) {
            KeyGroup const& keys = table->keys[group];
            found += near_keys(keys.numbers, keys.numbers, lanes_of(bucket, group), keys.features, 0, near,
                               NearNames{scratch.features, scratch.apart}.from(found));
        };
        if (has_groups())
            for (int i = 0; i < groups; ++i) look_at(static_cast<std::uint32_t>(scratch.groups[i]));
        else
            for (std::uint32_t group = first_group(); group < end_group(); ++group) look_at(group);
        return found;
    }
    /// Puts the one whose key is the nearest at the end: it will leave little room for the others.
    LORE_INLINE void look_at_keys() {
        candidates = near_keys_of_bucket();
        if (candidates == 0) return;
        int first = 0;
        for (int i = 1; i < candidates; ++i) first = scratch.apart[i] < scratch.apart[first] ? i : first;
        std::int32_t const feature = scratch.features[first], apart = scratch.apart[first];
        scratch.features[first] = scratch.features[candidates - 1];
        scratch.apart[first] = scratch.apart[candidates - 1];
        scratch.features[candidates - 1] = feature;
        scratch.apart[candidates - 1] = apart;
        fetch(feature);
    }
    LORE_INLINE void compare_nearest_key() {
        if (candidates == 0) return;
        --candidates;
        Promising nearest_key{scratch.features[candidates], scratch.apart[candidates], 0};
        if (is_wanted(nearest_key.feature) && is_promising_and_new(nearest_key))
            compare(nearest_key.feature, nearest_key.differing);
        std::int32_t const most = largest();
        int kept = 0;
        for (int i = 0; i < candidates; ++i) {
            scratch.promising[kept] = {scratch.features[i], scratch.apart[i], 0};
            kept += static_cast<int>(scratch.apart[i] <= most) & static_cast<int>(is_wanted(scratch.features[i]));
        }
        candidates = kept;
        for (int i = 0; i < candidates; ++i) __builtin_prefetch(pattern_of(scratch.promising[i].feature));
    }
    LORE_INLINE void look_at_patterns() {
        int kept = 0;
        for (int i = 0; i < candidates; ++i) {
            Promising one = scratch.promising[i];
            bool const keep = is_promising_and_new(one);
            scratch.promising[kept] = one;
            kept += keep;
        }
        candidates = kept;
        for (int i = 0; i < candidates; ++i) {
            std::uint8_t const* const codes = codes_of(scratch.promising[i].feature);
            for (int at = 0; at < shape().code_size; at += 64) __builtin_prefetch(codes + at);
        }
    }
    LORE_INLINE void compare_others() {
        for (int i = 0; i < candidates; ++i)
            if (is_promising(scratch.promising[i]))
                compare(scratch.promising[i].feature, scratch.promising[i].differing);
        if (!by_tables) return;
        int const number = scratch.visits[visits].table;
        if (shape().halves && number < 2) of_halves[number] = 1;
        else ++blocks[number % 2];
        ++visits;
    }
    LORE_INLINE void remember() const {
        if (scratch.recent == nullptr || nearest < 0) return;
        scratch.recent[recent_slot] = nearest;
        *scratch.last = {recent_slot, nearest};
    }

    /// The place in scratch.recent. Windows whose keys agree in their two highest bits are alike.
    LORE_INLINE std::uint64_t slot_of_recent() const {
        std::uint64_t const by_bits = hash_slot(words(), nullptr, word_count(), recent_bits);
        if (shape().hashes) return by_bits;
        std::uint64_t coarse[2];
        std::memcpy(coarse, &question.key, sizeof coarse);
        constexpr std::uint64_t highest[2]{0xc0c0c0c0c0c0c0c0u, 0x0000000000c0c0c0u};   // of Key::sums
        return by_bits ^ hash_slot(coarse, highest, 2, recent_bits);
    }
};

}   // namespace

}   // namespace lore::exact::LORE_ISA_NAMESPACE
