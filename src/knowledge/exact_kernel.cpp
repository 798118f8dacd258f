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

void pack(Shape const& shape, std::uint16_t const* bits, std::uint64_t* words) {
    for (int word = 0; word < shape.words; ++word) words[word] = 0;
    auto const place = [&](std::uint64_t pattern, int step, int size) {
        int const at = step * binary_count;
        words[at / 64] |= pattern << (at % 64);
        if (at % 64 + size > 64) words[at / 64 + 1] |= pattern >> (64 - at % 64);
    };
    int step = 0;
    for (; step + 4 <= shape.window_length; step += 4) place(four_steps(bits + step), step, 4 * binary_count);
    for (; step < shape.window_length; ++step) place(bits[step] & ((1u << binary_count) - 1), step, binary_count);
}

void summarize(Shape const& shape, float const* values, Digest& digest) {
    int const ends[2]{shape.first_half, shape.window_length};
    int step = 0;
    for (int half = 0; half < 2; ++half) {
        using Four = Lanes<float, 4>;
        Four low{}, high{};   // channels 0..3 and 2..5
        for (; step < ends[half]; ++step) {
            low += lanes::load<Four>(values + step * continuous_count);
            high += lanes::load<Four>(values + step * continuous_count + 2);
        }
        float sums[continuous_count];
        lanes::store(sums, low);
        lanes::store(sums + 2, high);
        for (int channel = 0; channel < continuous_count; ++channel) {
            float number = sums[channel] * shape.scales[half] + 0.5f;
            // A value outside 0 .. 1 moves to the edge, which only brings two summaries nearer to each other.
            number = number > 0 ? number : 0;
            number = number < summary_scale ? number : static_cast<float>(summary_scale);
            digest.summary[half * continuous_count + channel] = static_cast<std::uint8_t>(number);
        }
    }
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

/// FixedWords: the number of words if it is known when compiling, else 0.
template <int FixedWords>
LORE_INLINE int within_with(View const& view, std::uint64_t const* words, Candidate* out) {
    Shape const& shape = view.shape;
    int const count = FixedWords > 0 ? FixedWords : shape.words;
    auto const size = static_cast<std::size_t>(entry_size(count));
    int found = 0;
    constexpr int tables_at_once = 4;   // whose memory is fetched while the hashes of the others are computed
    for (int first = 0; first < shape.tables; first += tables_at_once) {
        int const last = first + tables_at_once < shape.tables ? first + tables_at_once : shape.tables;
        Bucket buckets[tables_at_once];
        for (int table = first; table < last; ++table) {
            std::uint64_t const slot = hash_slot(words, view.masks + table * count, count, view.slot_bits);
            buckets[table - first] = view.buckets[(static_cast<std::size_t>(table) << view.slot_bits) + slot];
        }
        for (int table = first; table < last; ++table)
            __builtin_prefetch(view.entries + buckets[table - first].start * size);
        for (int table = first; table < last; ++table) {
            Bucket const bucket = buckets[table - first];
            std::uint64_t const* pattern = view.entries + bucket.start * size;
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

int within(View const& view, std::uint64_t const* words, Candidate* out) {
    return view.shape.words == 3 ? within_with<3>(view, words, out) : within_with<0>(view, words, out);
}

int promising(View const& view, Digest const& window, Candidate const* in, int count, Candidate* out) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        Candidate const candidate = in[i];
        out[kept] = candidate;
        kept += summary_distance(window, candidate.digest) <= view.limits[candidate.differing];
    }
    std::size_t const value_count = static_cast<std::size_t>(view.shape.window_length) * continuous_count;
    for (int i = 0; i < kept; ++i) {   // they will be compared in full
        float const* const values = view.values + static_cast<std::size_t>(out[i].digest.feature) * value_count;
        for (std::size_t at = 0; at < value_count; at += 16) __builtin_prefetch(values + at);
    }
    return kept;
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

Nearest nearest(View const& view, Query const& query, Candidate const* candidates, int count) {
    Nearest best{-1, view.shape.squared_threshold};
    int const value_count = view.shape.window_length * continuous_count;
    for (int i = 0; i < count; ++i) {
        std::int32_t const feature = candidates[i].digest.feature;
        float const* const values =
            view.values + static_cast<std::size_t>(feature) * static_cast<std::size_t>(value_count);
        float const distance =
            continuous_distance(query.values, values, value_count) + static_cast<float>(candidates[i].differing);
        bool const nearer =
            distance < best.squared_distance || (distance == best.squared_distance && feature < best.feature);
        if (nearer) best = {feature, distance};
    }
    return best;
}

} // namespace

Kernel kernel() { return {pack, summarize, within, promising, nearest}; }

} // namespace lore::exact::LORE_ISA_NAMESPACE
