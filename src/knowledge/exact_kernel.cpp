#include "exact_kernel.h"
#include "exact_hash.h"

#include <lore/core/lanes.h>

namespace lore::exact::LORE_ISA_NAMESPACE {

namespace {

constexpr int partial_sums = 16;   // of the definition, knowledge/window.h

/// The binary channels of four steps, 36 bits.
LORE_INLINE std::uint64_t four_steps(std::uint16_t const* bits) {
    constexpr std::uint64_t channels = (1u << binary_count) - 1;
#if defined(__BMI2__)
    return _pext_u64(lanes::load<std::uint64_t>(bits), channels * 0x0001000100010001u);
#else
    return (bits[0] & channels) | (bits[1] & channels) << binary_count | (bits[2] & channels) << 2 * binary_count |
           (bits[3] & channels) << 3 * binary_count;
#endif
}

void prepare(Shape const& shape, std::uint16_t const* bits, float const* values, Query& query) {
    query.values = values;
    for (int word = 0; word < shape.words; ++word) query.words[word] = 0;
    auto const place = [&](std::uint64_t pattern, int step, int size) {
        int const at = step * binary_count;
        query.words[at / 64] |= pattern << (at % 64);
        if (at % 64 + size > 64) query.words[at / 64 + 1] |= pattern >> (64 - at % 64);
    };
    int step = 0;
    for (; step + 4 <= shape.window_length; step += 4) place(four_steps(bits + step), step, 4 * binary_count);
    for (; step < shape.window_length; ++step) place(bits[step] & ((1u << binary_count) - 1), step, binary_count);

    for (int i = summary_numbers; i < summary_size; ++i) query.summary[i] = 0;
    int const ends[2]{shape.first_half, shape.window_length};
    step = 0;
    for (int half = 0; half < 2; ++half) {
        using Four = Lanes<float, 4>;
        Four low{}, high{};   // channels 0..3 and 2..5
        for (; step < ends[half]; ++step) {
            low += lanes::load<Four>(values + step * continuous_count);
            high += lanes::load<Four>(values + step * continuous_count + 2);
        }
        float sums[continuous_count + 2];
        lanes::store(sums, low);
        lanes::store(sums + 2, high);
        for (int channel = 0; channel < continuous_count; ++channel) {
            float number = sums[channel] * shape.scales[half] + 0.5f;
            // A value outside 0 .. 1 moves to the edge, which only brings two summaries nearer to each other.
            number = number > 0 ? number : 0;
            number = number < summary_scale ? number : static_cast<float>(summary_scale);
            query.summary[half * continuous_count + channel] = static_cast<std::int16_t>(number);
        }
    }
}

LORE_INLINE std::int32_t summary_distance(std::int16_t const* a, std::int16_t const* b) {
#if defined(__SSE2__)
    auto const squares = [&](int at) {   // of the differences of eight numbers, added in pairs
        auto const* const from_a = reinterpret_cast<__m128i const*>(a + at);
        auto const* const from_b = reinterpret_cast<__m128i const*>(b + at);
        __m128i const difference = _mm_sub_epi16(_mm_loadu_si128(from_a), _mm_loadu_si128(from_b));
        return _mm_madd_epi16(difference, difference);
    };
    __m128i sum = _mm_add_epi32(squares(0), squares(8));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0x4e));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0xb1));
    return _mm_cvtsi128_si32(sum);
#else
    std::int32_t sum = 0;
    for (int i = 0; i < summary_size; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
#endif
}

/// Whether the tables before `table` have led to this feature already: all bits that one of them hashes are equal.
LORE_INLINE bool met_before(View const& view, int table, std::uint64_t const* words, std::uint64_t const* pattern, int count) {
    for (int earlier = 0; earlier < table; ++earlier) {
        std::uint64_t differing = 0;
        for (int word = 0; word < count; ++word) differing |= (words[word] ^ pattern[word]) & view.masks[earlier * count + word];
        if (differing == 0) return true;
    }
    return false;
}

/// FixedWords: the number of words if it is known when compiling, else 0.
template <int FixedWords>
LORE_INLINE int collect_with(View const& view, Query const& query, Candidate* candidates) {
    Shape const& shape = view.shape;
    int const words = FixedWords > 0 ? FixedWords : shape.words;
    std::size_t const entry_size = FixedWords > 0 ? FixedWords + 1 : static_cast<std::size_t>(shape.entry_size);
    std::size_t const value_stride = static_cast<std::size_t>(shape.value_stride);
    int near = 0;
    constexpr int tables_at_once = 4;   // whose memory is fetched while the hashes of the others are computed
    for (int first = 0; first < shape.tables; first += tables_at_once) {
        int const last = first + tables_at_once < shape.tables ? first + tables_at_once : shape.tables;
        Bucket buckets[tables_at_once];
        for (int table = first; table < last; ++table) {
            std::uint64_t const slot = hash_slot(query.words, view.masks + table * words, words, view.slot_bits);
            buckets[table - first] = view.buckets[(static_cast<std::size_t>(table) << view.slot_bits) + slot];
        }
        for (int table = first; table < last; ++table)
            __builtin_prefetch(view.entries + buckets[table - first].start * entry_size);
        for (int table = first; table < last; ++table) {
            Bucket const bucket = buckets[table - first];
            std::uint64_t const* pattern = view.entries + bucket.start * entry_size;
            for (std::uint32_t i = 0; i < bucket.count; ++i, pattern += entry_size) {
                int differing = 0;
                for (int word = 0; word < words; ++word) differing += __builtin_popcountll(query.words[word] ^ pattern[word]);
                // Written in any case, kept or overwritten: the outcome cannot be predicted, and a wrong guess of the
                // processor costs more than the rest of the loop.
                candidates[near] = {static_cast<std::int32_t>(pattern[words]), differing, bucket.start + i, table};
                near += differing <= shape.most_differing;
            }
        }
    }

    int count = 0;
    for (int i = 0; i < near; ++i) {
        Candidate const candidate = candidates[i];
        std::int16_t const* const summary = view.summaries + static_cast<std::size_t>(candidate.feature) * summary_size;
        candidates[count] = candidate;
        count += summary_distance(query.summary, summary) <= view.limits[candidate.differing];
    }

    int distinct = 0;
    for (int i = 0; i < count; ++i) {
        Candidate const candidate = candidates[i];
        if (met_before(view, candidate.table, query.words, view.entries + candidate.entry * entry_size, words)) continue;
        candidates[distinct++] = candidate;
        float const* const values = view.values + static_cast<std::size_t>(candidate.feature) * value_stride;
        for (std::size_t at = 0; at < value_stride; at += 16) __builtin_prefetch(values + at);
    }
    return distinct;
}

int collect(View const& view, Query const& query, Candidate* candidates) {
    return view.shape.words == 3 ? collect_with<3>(view, query, candidates) : collect_with<0>(view, query, candidates);
}

/// The part of squared_distance() (knowledge/window.h) that `count` values add, sum for sum.
LORE_INLINE float continuous_distance(float const* a, float const* b, int count) {
    using Vector = Lanes<float, LORE_LANES>;
    constexpr int vectors = partial_sums / LORE_LANES;
    Vector sums[vectors]{};
    int i = 0;
    for (; i + partial_sums <= count; i += partial_sums)
        for (int v = 0; v < vectors; ++v) {
            Vector const difference = lanes::load<Vector>(a + i + v * LORE_LANES) - lanes::load<Vector>(b + i + v * LORE_LANES);
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

Nearest nearest(View const& view, Query const& query, Candidate const* candidates, int count) {
    Nearest best{-1, view.shape.squared_threshold};
    int const value_count = view.shape.window_length * continuous_count;
    for (int i = 0; i < count; ++i) {
        Candidate const candidate = candidates[i];
        float const* const values = view.values + static_cast<std::size_t>(candidate.feature) * static_cast<std::size_t>(view.shape.value_stride);
        float const distance = continuous_distance(query.values, values, value_count) + static_cast<float>(candidate.differing);
        bool const nearer = distance < best.squared_distance ||
                            (distance == best.squared_distance && candidate.feature < best.feature);
        if (nearer) best = {candidate.feature, distance};
    }
    return best;
}

} // namespace

Kernel kernel() { return {prepare, collect, nearest}; }

} // namespace lore::exact::LORE_ISA_NAMESPACE
