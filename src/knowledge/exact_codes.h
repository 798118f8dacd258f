#pragma once

#include "exact_kernel.h"

#include <lore/core/lanes.h>

// A window's codes: its continuous values rounded to 255 steps, a byte each, zeros, and in the last four bytes of the
// whole cache lines that this takes, as a float, at least how far the rounded window lies from the window. Codes take a
// quarter of the values' memory; how far apart two windows are follows from theirs but for the two roundings.
namespace lore::exact {

LORE_INLINE float rounding_of(Shape const& shape, std::uint8_t const* codes) {
    return shape.code_size == 0 ? 0.0f : lanes::load<float>(codes + shape.code_size - sizeof(float));
}

/// Writes the codes of W values and returns the squares of what rounding has changed. A value outside 0 .. 1 moves to
/// the edge.
template <class F>
LORE_INLINE F encode_some(float const* values, std::uint8_t* codes) {
    using Int = IntOf<F>;
    using Byte = Lanes<std::uint8_t, LaneTraits<F>::width>;
    F const value = lanes::load<F>(values);
    F number = value * 255.0f + 0.5f;
    number = lanes::select(number > 0.0f, number, F{});
    number = lanes::select(number < 255.0f, number, lanes::all_of<F>(255.0f));
    Int whole;
    F difference;
    if constexpr (LaneTraits<F>::width == 1) {
        whole = static_cast<Int>(number);
        *codes = static_cast<std::uint8_t>(whole);
        difference = value - static_cast<float>(whole) * (1.0f / 255);
    } else {
        whole = __builtin_convertvector(number, Int);
        lanes::store(codes, __builtin_convertvector(whole, Byte));
        difference = value - __builtin_convertvector(whole, F) * (1.0f / 255);
    }
    return difference * difference;
}

LORE_INLINE void encode(Shape const& shape, float const* values, std::uint8_t* codes) {
    if (shape.code_size == 0) return;
    using Vector = Lanes<float, LORE_LANES>;
    int const count = shape.window_length * shape.continuous;
    Vector sums{};
    int i = 0;
    for (; i + LORE_LANES <= count; i += LORE_LANES) sums += encode_some<Vector>(values + i, codes + i);
    float squares = 0;
    for (int lane = 0; lane < LORE_LANES; ++lane) squares += sums[lane];
    for (; i < count; ++i) squares += encode_some<float>(values + i, codes + i);
    int const end = shape.code_size - static_cast<int>(sizeof(float));
    for (; i < end; ++i) codes[i] = 0;
    lanes::store(codes + end, __builtin_sqrtf(squares) * (1 + shape.relative_error) + shape.code_slack);
}

/// The sum of the squared differences of two windows' codes, nearly exact (5 * 2^-24 of it).
LORE_INLINE float code_squares(Shape const& shape, std::uint8_t const* a, std::uint8_t const* b) {
    int const size = shape.code_size;
    float all = 0;
#if defined(__AVX512BW__)
    constexpr __mmask64 whole_line = ~__mmask64{0}, last_line = whole_line >> sizeof(float);
    __m512i sums = _mm512_setzero_si512();   // a window's longest is far from filling one of them
    for (int at = 0; at < size; at += 64) {
        __mmask64 const there = at + 64 < size ? whole_line : last_line;
        __m512i const from_a = _mm512_maskz_loadu_epi8(there, a + at), from_b = _mm512_maskz_loadu_epi8(there, b + at);
        __m512i const apart = _mm512_or_si512(_mm512_subs_epu8(from_a, from_b), _mm512_subs_epu8(from_b, from_a));
        __m512i const low = _mm512_unpacklo_epi8(apart, _mm512_setzero_si512());
        __m512i const high = _mm512_unpackhi_epi8(apart, _mm512_setzero_si512());
        sums = _mm512_add_epi32(sums, _mm512_add_epi32(_mm512_madd_epi16(low, low), _mm512_madd_epi16(high, high)));
    }
    using Sixteen = Lanes<std::int32_t, 16>;
    auto const numbers = __builtin_convertvector(lanes::cast_bits<Sixteen>(sums), Lanes<float, 16>);
    auto const by_eight = __builtin_shufflevector(numbers, numbers, 0, 1, 2, 3, 4, 5, 6, 7) +
                          __builtin_shufflevector(numbers, numbers, 8, 9, 10, 11, 12, 13, 14, 15);
    auto const by_four = __builtin_shufflevector(by_eight, by_eight, 0, 1, 2, 3) +
                         __builtin_shufflevector(by_eight, by_eight, 4, 5, 6, 7);
    all = (by_four[0] + by_four[2]) + (by_four[1] + by_four[3]);
#else
    constexpr int summed_at_once = 1 << 14;   // 32 bits hold their squares
    for (int from = 0; from < size; from += summed_at_once) {
        int const end = size - static_cast<int>(sizeof(float));
        int const until = end - from < summed_at_once ? end : from + summed_at_once;
        int at = from;
        std::int32_t sum = 0;
#if defined(__SSE2__)
        __m128i sums = _mm_setzero_si128();
        for (; at + 16 <= until; at += 16) {
            __m128i const from_a = _mm_loadu_si128(reinterpret_cast<__m128i const*>(a + at));
            __m128i const from_b = _mm_loadu_si128(reinterpret_cast<__m128i const*>(b + at));
            __m128i const apart = _mm_or_si128(_mm_subs_epu8(from_a, from_b), _mm_subs_epu8(from_b, from_a));
            __m128i const low = _mm_unpacklo_epi8(apart, _mm_setzero_si128());
            __m128i const high = _mm_unpackhi_epi8(apart, _mm_setzero_si128());
            sums = _mm_add_epi32(sums, _mm_add_epi32(_mm_madd_epi16(low, low), _mm_madd_epi16(high, high)));
        }
        sums = _mm_add_epi32(sums, _mm_shuffle_epi32(sums, 0x4e));
        sums = _mm_add_epi32(sums, _mm_shuffle_epi32(sums, 0xb1));
        sum = _mm_cvtsi128_si32(sums);
#endif
        for (; at < until; ++at) sum += (a[at] - b[at]) * (a[at] - b[at]);
        all += static_cast<float>(sum);
    }
#endif
    return all;
}

}   // namespace lore::exact
