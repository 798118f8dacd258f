#pragma once

#include "exact_kernel.h"

#include <lore/core/lanes.h>

#include <cstdint>
#include <cstring>

// Which of many keys are so near to one that their features may match (exact_shape.h, bounds 1 and 3).
namespace lore::exact {

/// Whether a feature with the pattern and sums of `a` may be as near to `b` as these allow.
LORE_INLINE bool keys_are_near(Key const& a, Key const& b, int most_differing, std::int32_t largest) {
    std::int32_t sum = 0;
    for (int i = 0; i < key_size; ++i) sum += (a.sums[i] - b.sums[i]) * (a.sums[i] - b.sums[i]);
    int const ones = a.ones > b.ones ? a.ones - b.ones : b.ones - a.ones;
    return sum <= largest && ones <= most_differing;
}

/// Writes the numbers of those that keys_are_near, and returns how many.
LORE_INLINE int near_keys(Key const* keys, std::int32_t const* numbers, int count, Key const& key, int most_differing,
                          std::int32_t largest, std::int32_t* out) {
    int found = 0, i = 0;
    // Several keys at once.
    std::int64_t wanted_bits;
    std::memcpy(&wanted_bits, &key, sizeof wanted_bits);
    Key const most{{255, 255, 255, 255, 255, 255, 255},
                   static_cast<std::uint8_t>(most_differing < 255 ? most_differing : 255)};
    std::int64_t allowed_bits;
    std::memcpy(&allowed_bits, &most, sizeof allowed_bits);
#if defined(__AVX512BW__) && defined(__AVX512VL__) && defined(__BMI2__)
    // Differences of 127 and more count as 127, so that their squares fit; that only lets a key pass that is far.
    constexpr std::int64_t most_squared = 0x007f7f7f7f7f7f7f;
    __m512i const wanted = _mm512_set1_epi64(wanted_bits);
    __m512i const allowed = _mm512_set1_epi64(allowed_bits);
    __m512i const limits = _mm512_set1_epi64(most_squared);
    __m512i const one_each = _mm512_set1_epi16(1);
    __m512i const bound = _mm512_set1_epi64((std::int64_t{largest} << 32) | 0xffffffff);
    for (; i < count; i += 8) {
        auto const there = static_cast<__mmask8>(count - i >= 8 ? 0xff : (1 << (count - i)) - 1);
        __m512i const eight = _mm512_maskz_loadu_epi64(there, keys + i);
        __m512i const difference = _mm512_or_si512(_mm512_subs_epu8(eight, wanted), _mm512_subs_epu8(wanted, eight));
        // Key::ones is the highest byte, and decides.
        __mmask8 const alike = _mm512_mask_cmple_epu64_mask(there, difference, allowed);
        __m512i const squared = _mm512_min_epu8(difference, limits);
        __m512i terms = _mm512_madd_epi16(_mm512_maddubs_epi16(squared, squared), one_each);
        terms = _mm512_add_epi32(terms, _mm512_maskz_shuffle_epi32(0xffff, terms, _MM_PERM_CDAB));
        __mmask8 const near = _mm512_mask_cmple_epu64_mask(alike, terms, bound);   // the higher halves decide
        __m256i const their_numbers = _mm256_maskz_loadu_epi32(there, numbers + i);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + found), _mm256_maskz_compress_epi32(near, their_numbers));
        found += __builtin_popcount(near);
    }
#elif defined(__SSE2__)
    constexpr std::int64_t sums_bits = 0x00ffffffffffffff;   // Key::sums; Key::ones above them
    __m128i const wanted = _mm_set1_epi64x(wanted_bits);
    __m128i const sums = _mm_set1_epi64x(sums_bits);   // too many differing ones become a term that no bound allows
    __m128i const allowed = _mm_set1_epi64x(allowed_bits);
    __m128i const bound = _mm_set1_epi32(largest);
    for (; i + 2 <= count; i += 2) {
        __m128i const two = _mm_loadu_si128(reinterpret_cast<__m128i const*>(keys + i));
        __m128i const difference = _mm_or_si128(_mm_subs_epu8(two, wanted), _mm_subs_epu8(wanted, two));
        __m128i const excess = _mm_subs_epu8(difference, allowed);
        __m128i const terms = _mm_and_si128(difference, sums);
        __m128i const first = _mm_unpacklo_epi8(terms, excess), second = _mm_unpackhi_epi8(terms, excess);
        __m128i const a = _mm_madd_epi16(first, first), b = _mm_madd_epi16(second, second);
        __m128i pairs = _mm_add_epi32(_mm_unpacklo_epi64(a, b), _mm_unpackhi_epi64(a, b));
        pairs = _mm_add_epi32(pairs, _mm_shuffle_epi32(pairs, 0xb1));
        int const far = _mm_movemask_epi8(_mm_cmpgt_epi32(pairs, bound));
        out[found] = numbers[i];
        found += (far & 1) == 0;
        out[found] = numbers[i + 1];
        found += (far >> 8 & 1) == 0;
    }
#endif
    for (; i < count; ++i) {
        out[found] = numbers[i];
        found += keys_are_near(keys[i], key, most_differing, largest);
    }
    return found;
}

}   // namespace lore::exact
