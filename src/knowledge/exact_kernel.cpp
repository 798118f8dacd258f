#include "exact_kernel.h"
#include "exact_hash.h"
#include "exact_keys.h"
#include "exact_window.h"

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

Key summarize_with_key(Shape const& shape, std::uint64_t const* words, float const* values, Digest& digest) {
    Sums sums;
    add_up(shape, values, sums);
    put_summary(shape, sums, digest);
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

/// Keys of one bucket that are looked through before what was found among them is compared, where one bucket holds all.
constexpr std::uint32_t keys_at_once = 2048;

/// One question to a set by its keys. As the search goes on, the best so far leaves less and less room for a better
/// one.
struct KeyedSearch {
    KeyedView const& view;
    Query const& query;
    Digest const& summary;
    Key const& key;
    Scratch scratch;
    Nearest best;

    LORE_INLINE Shape const& shape() const { return view.shape; }
    LORE_INLINE int value_count() const { return shape().window_length * shape().continuous; }
    LORE_INLINE std::uint64_t const* record_of(std::int32_t feature) const {
        return view.records + static_cast<std::size_t>(feature) * static_cast<std::size_t>(record_size(shape().words));
    }
    LORE_INLINE float const* values_of(std::int32_t feature) const {
        return view.values + static_cast<std::size_t>(feature) * static_cast<std::size_t>(value_count());
    }
    LORE_INLINE int differing_bits(std::uint64_t const* record) const {
        int differing = 0;
        for (int word = 0; word < shape().words; ++word)
            differing += __builtin_popcountll(query.words[word] ^ record[word]);
        return differing;
    }
    /// Bits in which a better one may differ. In float first: a threshold may be beyond any int.
    LORE_INLINE int most_bits() const {
        return best.squared_distance < static_cast<float>(shape().most_differing)
                   ? static_cast<int>(best.squared_distance)
                   : shape().most_differing;
    }
    /// What the continuous channels of a better one that differs in so many bits may add to its squared distance.
    LORE_INLINE float left(int differing) const {
        return best.squared_distance * (1 + shape().relative_error) - static_cast<float>(differing);
    }
    LORE_INLINE void compare(std::int32_t feature, int differing) {
        take_if_nearer(best, feature,
                       continuous_distance(query.values, values_of(feature), value_count()) +
                           static_cast<float>(differing));
    }

    /// A table's bucket of the window.
    LORE_INLINE Bucket bucket_of(int table) const {
        std::uint64_t const slot =
            hash_slot(query.words, view.tables.masks + table * shape().words, shape().words, view.tables.slot_bits);
        return view.tables.buckets[(static_cast<std::size_t>(table) << view.tables.slot_bits) + slot];
    }

    /// Puts the window's buckets into the order in which they are visited: often one is enough. First those of the
    /// halves, then those of the blocks of the half whose buckets are smaller; of each the smaller ones first.
    LORE_INLINE void order_visits() {
        int const halves = shape().halves ? 2 : 0, tables = growing_tables(shape());
        std::uint32_t in_blocks[2] = {0, 0};
        for (int table = 0; table < tables; ++table) {
            scratch.visits[table] = {bucket_of(table), table};
            if (table >= halves) in_blocks[table % 2] += scratch.visits[table].bucket.count;
        }
        int const smaller = in_blocks[1] < in_blocks[0];
        auto const rank = [&](Visit const& visit) {
            std::uint64_t const group = visit.table < halves ? 0 : halves > 0 && visit.table % 2 != smaller ? 2 : 1;
            return group << 32 | visit.bucket.count;
        };
        for (int table = 1; table < tables; ++table) {
            Visit const visit = scratch.visits[table];
            int place = table;
            for (; place > 0 && rank(scratch.visits[place - 1]) > rank(visit); --place)
                scratch.visits[place] = scratch.visits[place - 1];
            scratch.visits[place] = visit;
        }
        for (int visit = 0; visit < 2 && visit < tables; ++visit) {
            __builtin_prefetch(view.keys + scratch.visits[visit].bucket.start);
            __builtin_prefetch(view.numbers + scratch.visits[visit].bucket.start);
        }
    }

    /// Such a feature has been seen in one of the first `visits` buckets.
    LORE_INLINE bool shares_a_block(std::uint64_t const* record, int visits) const {
        for (int visit = 0; visit < visits; ++visit) {
            std::uint64_t const* const mask = view.tables.masks + scratch.visits[visit].table * shape().words;
            std::uint64_t differing = 0;
            for (int word = 0; word < shape().words; ++word)
                differing |= (query.words[word] ^ record[word]) & mask[word];
            if (differing == 0) return true;
        }
        return false;
    }

    /// Writes the features of a bucket that may be better to scratch.promising, and returns how many. `visits` buckets
    /// were seen before; who was in none of them differs in `unseen` bits or more.
    LORE_INLINE int sift(Bucket bucket, int visits, int unseen) {
        int const count =
            near_keys(view.keys + bucket.start, view.numbers + bucket.start, static_cast<int>(bucket.count), key,
                      most_bits(), shape().key_bound.largest(left(unseen)), scratch.numbers);
        for (int i = 0; i < count; ++i) __builtin_prefetch(record_of(scratch.numbers[i]));
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            std::uint64_t const* const record = record_of(scratch.numbers[i]);
            int const differing = differing_bits(record);
            if (differing > most_bits() || shares_a_block(record, visits)) continue;
            Digest digest;
            std::memcpy(&digest, record + shape().words, sizeof digest);
            Promising const one{digest.feature, differing, summary_distance(summary, digest)};
            if (is_promising(one)) scratch.promising[kept++] = one;
        }
        return kept;
    }

    LORE_INLINE bool is_promising(Promising const& one) const {
        return one.apart <= shape().summary_bound.largest(left(one.differing));
    }
    /// Grows with the squared distance that bits and summary let expect.
    LORE_INLINE float expected(Promising const& one) const {
        return static_cast<float>(one.apart) + shape().summary_bound.slope * static_cast<float>(one.differing);
    }

    /// Compares those of a bucket that may be better, as sift() finds them. The one that is expected to be the nearest
    /// comes first: it leaves little room for the others, whose values lie elsewhere in memory.
    LORE_INLINE void look_through(Bucket bucket, int visits, int unseen) {
        int const count = sift(bucket, visits, unseen);
        if (count == 0) return;
        Promising* const promising = scratch.promising;
        int first = 0;
        for (int i = 1; i < count; ++i)
            if (expected(promising[i]) < expected(promising[first])) first = i;
        compare(promising[first].feature, promising[first].differing);
        int others = 0;
        for (int i = 0; i < count; ++i) {
            if (i == first || !is_promising(promising[i])) continue;
            float const* const values = values_of(promising[i].feature);
            for (int at = 0; at < value_count(); at += 16) __builtin_prefetch(values + at);
            promising[others++] = promising[i];
        }
        for (int i = 0; i < others; ++i)
            if (is_promising(promising[i])) compare(promising[i].feature, promising[i].differing);
    }
    /// The same by shares, the first of which find something that shortens the others.
    LORE_INLINE void look_through_shares(Bucket bucket) {
        while (bucket.count > 0) {
            Bucket const share{bucket.start, bucket.count < keys_at_once ? bucket.count : keys_at_once};
            look_through(share, 0, 0);
            bucket.start += share.count;
            bucket.count -= share.count;
        }
    }

    /// A feature in none of the buckets seen so far differs in a bit of each half and of each block that they were of.
    LORE_INLINE void look_through_tables() {
        int blocks[2] = {0, 0};      // seen, of the even and of the odd ones
        int of_halves[2] = {0, 0};   // 1: the half was seen
        for (int visit = 0; visit < growing_tables(shape()); ++visit) {
            int unseen = 0;
            for (int half = 0; half < 2; ++half)
                unseen += blocks[half] > of_halves[half] ? blocks[half] : of_halves[half];
            if (best.squared_distance < static_cast<float>(unseen)) break;
            look_through(scratch.visits[visit].bucket, visit, unseen);
            int const table = scratch.visits[visit].table;
            if (shape().halves && table < 2) of_halves[table] = 1;
            else ++blocks[table % 2];
        }
    }

    /// The place in scratch.recent. Windows whose keys agree in their two highest bits are alike.
    LORE_INLINE std::uint64_t recent_slot() const {
        std::uint64_t const by_bits = hash_slot(query.words, nullptr, shape().words, recent_bits);
        if (shape().hashes) return by_bits;
        std::uint64_t coarse;
        std::memcpy(&coarse, &key, sizeof coarse);
        coarse &= 0x00c0c0c0c0c0c0c0u;
        return by_bits ^ hash_slot(&coarse, nullptr, 1, recent_bits);
    }
};

Nearest closest(KeyedView const& view, Query const& query, Digest const& summary, Key const& key, Scratch scratch) {
    Shape const& shape = view.shape;
    KeyedSearch search{view, query, summary, key, scratch, {-1, shape.squared_threshold}};
    search.order_visits();
    std::int32_t& recent = scratch.recent[search.recent_slot()];
    if (recent >= 0) search.compare(recent, search.differing_bits(search.record_of(recent)));
    if (!shape.hashes) search.look_through_shares(scratch.visits[0].bucket);
    else search.look_through_tables();
    if (search.best.feature >= 0) recent = search.best.feature;
    return search.best;
}

Nearest closest_among(KeyedView const& view, Query const& query, Digest const& summary, Key const& key, Scratch scratch,
                      Bucket places, Nearest best) {
    KeyedSearch search{view, query, summary, key, scratch, best};
    search.look_through_shares(places);
    return search.best;
}

bool any_within(KeyedView const& view, std::uint64_t const* words, Bucket places) {
    int const count = view.shape.words;
    for (std::uint32_t i = places.start; i < places.start + places.count; ++i) {
        std::uint64_t const* const record =
            view.records + static_cast<std::size_t>(view.numbers[i]) * static_cast<std::size_t>(record_size(count));
        int differing = 0;
        for (int word = 0; word < count; ++word) differing += __builtin_popcountll(words[word] ^ record[word]);
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
    return {pack, summarize, summarize_with_key, closest, closest_among, any_within, within, promising, nearest};
}

}   // namespace lore::exact::LORE_ISA_NAMESPACE
