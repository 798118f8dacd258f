#include "exact_kernel.h"
#include "exact_hash.h"

#include <lore/core/lanes.h>

namespace lore::exact::LORE_ISA_NAMESPACE {

namespace {

constexpr int partial_sums = 16;   // of the definition, knowledge/window.h

void prepare(Shape const& shape, std::uint16_t const* bits, float const* values, Query& query) {
    for (int word = 0; word < shape.words; ++word) query.words[word] = 0;
    for (int step = 0; step < shape.window_length; ++step) {
        std::uint64_t const channels = bits[step] & ((1u << binary_count) - 1);
        int const at = step * binary_count;
        query.words[at / 64] |= channels << (at % 64);
        if (at % 64 > 64 - binary_count) query.words[at / 64 + 1] |= channels >> (64 - at % 64);
    }

    int const count = shape.window_length * continuous_count;
    std::memcpy(query.values, values, sizeof(float) * static_cast<std::size_t>(count));
    for (int i = count; i < shape.value_stride; ++i) query.values[i] = 0;

    int const ends[2]{shape.first_half, shape.window_length};
    int step = 0;
    for (int half = 0; half < 2; ++half) {
        float sums[continuous_count]{};
        for (; step < ends[half]; ++step)
            for (int channel = 0; channel < continuous_count; ++channel) sums[channel] += values[step * continuous_count + channel];
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
    std::int32_t sum = 0;
    for (int i = 0; i < summary_size; ++i) {
        std::int32_t const difference = a[i] - b[i];
        sum += difference * difference;
    }
    return sum;
}

/// FixedWords: the number of words if it is known when compiling, else 0.
template <int FixedWords>
LORE_INLINE int collect_with(View const& view, Query const& query, Candidate* candidates) {
    Shape const& shape = view.shape;
    int const words = FixedWords > 0 ? FixedWords : shape.words;
    std::size_t const record_bytes = static_cast<std::size_t>(shape.record_lines) * 64;
    std::size_t const value_stride = static_cast<std::size_t>(shape.value_stride);
    int count = 0;
    for (int table = 0; table < shape.tables; ++table) {
        std::uint64_t const slot = hash_slot(query.words, view.masks + table * words, words, view.head_bits);
        std::int32_t feature = view.heads[(static_cast<std::size_t>(table) << view.head_bits) + slot];
        while (feature >= 0) {
            std::byte const* const record = view.records + static_cast<std::size_t>(feature) * record_bytes;
            std::int32_t const here = feature;
            std::memcpy(&feature, record + shape.next_offset + 4 * table, sizeof feature);
            auto const* const pattern = reinterpret_cast<std::uint64_t const*>(record);
            int differing = 0;
            for (int word = 0; word < words; ++word) differing += __builtin_popcountll(query.words[word] ^ pattern[word]);
            if (differing > shape.most_differing) continue;
            auto const* const summary = reinterpret_cast<std::int16_t const*>(record + shape.summary_offset);
            if (summary_distance(query.summary, summary) > view.limits[differing]) continue;
            bool met_before = false;   // in the chain of an earlier table, whose bits are equal too
            for (int earlier = 0; earlier < table && !met_before; ++earlier) {
                std::uint64_t rest = 0;
                for (int word = 0; word < words; ++word)
                    rest |= (query.words[word] ^ pattern[word]) & view.masks[earlier * words + word];
                met_before = rest == 0;
            }
            if (met_before) continue;
            candidates[count++] = {here, differing};
            auto const* const values = reinterpret_cast<char const*>(view.values + static_cast<std::size_t>(here) * value_stride);
            for (std::size_t line = 0; line < value_stride * sizeof(float); line += 64) __builtin_prefetch(values + line);
        }
    }
    return count;
}

int collect(View const& view, Query const& query, Candidate* candidates) {
    return view.shape.words == 3 ? collect_with<3>(view, query, candidates) : collect_with<0>(view, query, candidates);
}

/// As squared_distance() of knowledge/window.h, sum for sum; the padding adds zeros.
LORE_INLINE float continuous_distance(float const* a, float const* b, int count) {
    using Vector = Lanes<float, LORE_LANES>;
    constexpr int vectors = partial_sums / LORE_LANES;
    Vector sums[vectors]{};
    for (int i = 0; i < count; i += partial_sums)
        for (int v = 0; v < vectors; ++v) {
            Vector const difference = lanes::load<Vector>(a + i + v * LORE_LANES) - lanes::load<Vector>(b + i + v * LORE_LANES);
            sums[v] += difference * difference;
        }
    float partial[partial_sums];
    for (int v = 0; v < vectors; ++v) lanes::store(partial + v * LORE_LANES, sums[v]);
    using Four = Lanes<float, 4>;
    Four const by_eight_low = lanes::load<Four>(partial) + lanes::load<Four>(partial + 8);
    Four const by_eight_high = lanes::load<Four>(partial + 4) + lanes::load<Four>(partial + 12);
    Four const by_four = by_eight_low + by_eight_high;
    return (by_four[0] + by_four[2]) + (by_four[1] + by_four[3]);
}

Nearest nearest(View const& view, Query const& query, Candidate const* candidates, int count) {
    Nearest best{-1, view.shape.squared_threshold};
    for (int i = 0; i < count; ++i) {
        Candidate const candidate = candidates[i];
        float const* const values = view.values + static_cast<std::size_t>(candidate.feature) * static_cast<std::size_t>(view.shape.value_stride);
        float const distance = continuous_distance(query.values, values, view.shape.value_stride) + static_cast<float>(candidate.differing);
        bool const nearer = distance < best.squared_distance ||
                            (distance == best.squared_distance && candidate.feature < best.feature);
        if (nearer) best = {candidate.feature, distance};
    }
    return best;
}

} // namespace

Kernel kernel() { return {prepare, collect, nearest}; }

} // namespace lore::exact::LORE_ISA_NAMESPACE
