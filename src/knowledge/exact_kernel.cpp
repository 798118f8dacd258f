#include "exact_kernel.h"
#include "exact_codes.h"
#include "exact_hash.h"
#include "exact_window.h"
#include "keyed_search.h"

#include <lore/core/lanes.h>

namespace lore::exact::LORE_ISA_NAMESPACE {

namespace {

constexpr int partial_sums = 16;   // of the definition, knowledge/window.h

void pack(Shape const& shape, std::uint16_t const* bits, std::uint64_t* words) { pack_window(shape, bits, words); }

void summarize(Shape const& shape, float const* values, Digest& digest) {
    Sums sums;
    add_up(shape, values, sums);
    put_summary(shape, sums, digest);
}

Key describe(Shape const& shape, std::uint16_t const* bits, float const* values, std::uint64_t* words,
             std::uint8_t* codes) {
    pack_window(shape, bits, words);
    encode(shape, values, codes);
    Sums sums;
    add_up(shape, values, sums);
    return key_of(shape, words, sums);
}

/// The sum of the squared differences of two summaries.
LORE_INLINE std::int32_t summary_distance(Digest const& a, Digest const& b) {
#if defined(__SSE2__)
    __m128i const numbers = _mm_set_epi32(0, -1, -1, -1);   // not the feature's number behind them
    __m128i const from_a = _mm_and_si128(numbers, _mm_loadu_si128(reinterpret_cast<__m128i const*>(&a)));
    __m128i const from_b = _mm_and_si128(numbers, _mm_loadu_si128(reinterpret_cast<__m128i const*>(&b)));
    __m128i const difference = _mm_or_si128(_mm_subs_epu8(from_a, from_b), _mm_subs_epu8(from_b, from_a));
    __m128i const low = _mm_unpacklo_epi8(difference, _mm_setzero_si128());
    __m128i const high = _mm_unpackhi_epi8(difference, _mm_setzero_si128());
    __m128i sum = _mm_add_epi32(_mm_madd_epi16(low, low), _mm_madd_epi16(high, high));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0x4e));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0xb1));
    return _mm_cvtsi128_si32(sum);
#else
    std::int32_t sum = 0;
    for (int i = 0; i < summary_size; ++i) sum += (a.summary[i] - b.summary[i]) * (a.summary[i] - b.summary[i]);
    return sum;
#endif
}

/// The part of squared_distance() (knowledge/window.h) that `count` values add, sum for sum.
LORE_INLINE float continuous_distance(float const* a, float const* b, int count) {
    using Vector = Lanes<float, LORE_LANES>;
    constexpr int vectors = partial_sums / LORE_LANES;
    Vector sums[vectors]{};
    int i = 0;
    for (; i + partial_sums <= count; i += partial_sums)
        for (int v = 0; v < vectors; ++v) {
            Vector const difference =
                lanes::load<Vector>(a + i + v * LORE_LANES) - lanes::load<Vector>(b + i + v * LORE_LANES);
            sums[v] += difference * difference;
        }
    float partial[partial_sums];
    for (int v = 0; v < vectors; ++v) lanes::store(partial + v * LORE_LANES, sums[v]);
    for (int rest = 0; i < count; ++rest, ++i) {
        float const difference = a[i] - b[i];
        partial[rest] += difference * difference;
    }
    using Four = Lanes<float, 4>;
    Four const by_eight_low = lanes::load<Four>(partial) + lanes::load<Four>(partial + 8);
    Four const by_eight_high = lanes::load<Four>(partial + 4) + lanes::load<Four>(partial + 12);
    Four const by_four = by_eight_low + by_eight_high;
    return (by_four[0] + by_four[2]) + (by_four[1] + by_four[3]);
}

LORE_INLINE void take_if_nearer(Nearest& best, std::int32_t feature, float distance) {
    if (distance < best.squared_distance || (distance == best.squared_distance && feature < best.feature))
        best = {feature, distance};
}

template <int FixedWords>
LORE_INLINE KeyedSearch<FixedWords> begun(KeyedView const& view, bool by_tables, Search const& asked) {
    KeyedSearch<FixedWords> search;
    search.view = &view;
    search.by_tables = by_tables;
    search.question = asked.question;
    search.scratch = asked.scratch;
    search.features = asked.wanted.features;
    search.bound = asked.wanted.bound;
    return search;
}

/// Bucket after bucket, until no search has one that is worth it. Changes the order of `going`.
template <int FixedWords>
LORE_INLINE void look_through_buckets(KeyedSearch<FixedWords>** going, int count) {
    while (count > 0) {
        int left = 0;
        for (int i = 0; i < count; ++i)
            if (going[i]->choose_bucket()) going[left++] = going[i];
        count = left;
        for (int i = 0; i < count; ++i) going[i]->look_at_groups();
        for (int i = 0; i < count; ++i) going[i]->look_at_keys();
        for (int i = 0; i < count; ++i) going[i]->compare_nearest_key();
        for (int i = 0; i < count; ++i) going[i]->look_at_patterns();
        for (int i = 0; i < count; ++i) going[i]->compare_others();
    }
}

template <int FixedWords, int together>
LORE_INLINE void search_together(KeyedView const& view, Search* asked, int count) {
    KeyedSearch<FixedWords> searches[together];
    KeyedSearch<FixedWords>* going[together];
    for (int i = 0; i < count; ++i) {
        searches[i] = begun<FixedWords>(view, view.shape.hashes, asked[i]);
        going[i] = &searches[i];
        going[i]->fetch_buckets();
    }
    for (int i = 0; i < count; ++i) going[i]->order_visits();
    for (int i = 0; i < count; ++i) going[i]->compare_first();
    look_through_buckets(going, count);
    for (int i = 0; i < count; ++i) {
        searches[i].remember();
        asked[i].finalists = searches[i].remaining();
    }
}

void closest(KeyedView const& view, Search* asked, int count) {
    constexpr int usual_words = 3;   // windows of collectball
    if (count == 1) search_together<0, 1>(view, asked, count);
    else if (view.shape.words == usual_words) search_together<usual_words, searches_together>(view, asked, count);
    else search_together<0, searches_together>(view, asked, count);
}

void closest_among(KeyedView const& view, Search& asked, Bucket places) {
    KeyedSearch<0> search = begun<0>(view, false, asked), *going = &search;
    search.rest = places;
    look_through_buckets(&going, 1);
    asked.finalists = search.remaining();
}

float distance(Shape const& shape, float const* a, float const* b) {
    return continuous_distance(a, b, shape.window_length * shape.continuous);
}

bool any_within(KeyedView const& view, std::uint64_t const* words, Bucket places) {
    int const count = view.shape.words;
    for (std::uint32_t i = places.start; i < places.start + places.count; ++i) {
        auto const feature = static_cast<std::size_t>(view.tables->keys[i / key_group].features[i % key_group]);
        std::uint64_t const* const pattern = view.patterns + feature * static_cast<std::size_t>(pattern_room(count));
        int differing = 0;
        for (int word = 0; word < count; ++word) differing += __builtin_popcountll(words[word] ^ pattern[word]);
        if (differing <= view.shape.most_differing) return true;
    }
    return false;
}

/// FixedWords: the number of words if it is known when compiling, else 0.
template <int FixedWords>
LORE_INLINE int within_with(FixedView const& view, std::uint64_t const* words, Candidate* out) {
    Shape const& shape = view.shape;
    int const count = FixedWords > 0 ? FixedWords : shape.words;
    auto const size = static_cast<std::size_t>(record_size(count));
    int found = 0;
    constexpr int tables_at_once = 4;   // whose memory is fetched while the hashes of the others are computed
    for (int first = 0; first < shape.tables; first += tables_at_once) {
        int const last = first + tables_at_once < shape.tables ? first + tables_at_once : shape.tables;
        Bucket buckets[tables_at_once];
        for (int table = first; table < last; ++table) {
            std::uint64_t const slot =
                hash_slot(words, view.tables.masks + table * count, count, view.tables.slot_bits);
            buckets[table - first] =
                view.tables.buckets[(static_cast<std::size_t>(table) << view.tables.slot_bits) + slot];
        }
        for (int table = first; table < last; ++table)
            __builtin_prefetch(view.records + buckets[table - first].start * size);
        for (int table = first; table < last; ++table) {
            Bucket const bucket = buckets[table - first];
            std::uint64_t const* pattern = view.records + bucket.start * size;
            for (std::uint32_t i = 0; i < bucket.count; ++i, pattern += size) {
                int differing = 0;
                for (int word = 0; word < count; ++word) differing += __builtin_popcountll(words[word] ^ pattern[word]);
                // Written in any case, kept or overwritten: the outcome cannot be predicted, and a wrong guess of the
                // processor costs more than the rest of the loop.
                std::memcpy(&out[found].digest, pattern + count, sizeof(Digest));
                out[found].differing = differing;
                found += differing <= shape.most_differing;
            }
        }
    }
    return found;
}

int within(FixedView const& view, std::uint64_t const* words, Candidate* out) {
    return view.shape.words == 3 ? within_with<3>(view, words, out) : within_with<0>(view, words, out);
}

int promising(FixedView const& view, Digest const& window, Candidate const* in, int count, Candidate* out) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        Candidate const candidate = in[i];
        out[kept] = candidate;
        kept += summary_distance(window, candidate.digest) <= view.limits[candidate.differing];
    }
    std::size_t const value_count = static_cast<std::size_t>(view.shape.window_length * view.shape.continuous);
    for (int i = 0; i < kept; ++i) {   // they will be compared in full
        float const* const values = view.values + static_cast<std::size_t>(out[i].digest.feature) * value_count;
        for (std::size_t at = 0; at < value_count; at += 16) __builtin_prefetch(values + at);
    }
    return kept;
}

Nearest nearest(FixedView const& view, Query const& query, Candidate const* candidates, int count) {
    Nearest best{-1, view.shape.squared_threshold};
    int const value_count = view.shape.window_length * view.shape.continuous;
    for (int i = 0; i < count; ++i) {
        std::int32_t const feature = candidates[i].digest.feature;
        float const* const values =
            view.values + static_cast<std::size_t>(feature) * static_cast<std::size_t>(value_count);
        float const distance =
            continuous_distance(query.values, values, value_count) + static_cast<float>(candidates[i].differing);
        take_if_nearer(best, feature, distance);
    }
    return best;
}

}   // namespace

Kernel kernel() {
    return {pack, summarize, describe, closest, closest_among, distance, any_within, within, promising, nearest};
}

}   // namespace lore::exact::LORE_ISA_NAMESPACE
