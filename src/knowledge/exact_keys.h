#pragma once

#include "exact_kernel.h"

#include <lore/core/lanes.h>

#include <cstdint>
#include <cstring>

// Which of many keys are so near to one that their features may match (exact_shape.h, bounds 1 and 3).
namespace lore::exact {

/// Which keys are near: those whose sums differ by squares that add up to at most `largest`, and whose ones by at most
/// `most_differing`.
struct NearKeys {
    Key key;
    int most_differing;
    std::int32_t largest;
};

/// How far a byte is from a range.
LORE_INLINE int outside(std::uint8_t byte, std::uint8_t least, std::uint8_t most) {
    return byte < least ? least - byte : byte > most ? byte - most : 0;
}

/// How far apart the sums of two keys are at least, in squares, if one lies between `least` and `most`, byte for byte.
LORE_INLINE std::int32_t sums_apart(Key const& key, Key const& least, Key const& most) {
    std::int32_t sum = 0;
    for (int i = 0; i < key_size; ++i) {
        int const apart = outside(key.sums[i], least.sums[i], most.sums[i]);
        sum += apart * apart;
    }
    return sum;
}

/// Where near_keys writes features and how far their keys are apart; each has room for all keys and spare_keys more.
struct NearFeatures {
    std::int32_t *features, *apart;
    LORE_INLINE NearFeatures from(int place) const { return {features + place, apart + place}; }
};

/// Writes the features of those of `count` keys that are near, or may be near if they lie between `least` and `most`,
/// and returns how many.
LORE_INLINE int near_keys(Key const* least, Key const* most, int count, NearKeys const& near, NearFeatures out) {
    int found = 0, i = 0;
#if defined(__SSE2__)
    Key const at_most{{255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255},
                      static_cast<std::uint8_t>(near.most_differing < 255 ? near.most_differing : 255),
                      -1};
    __m128i const wanted_one = lanes::cast_bits<__m128i>(near.key), allowed_one = lanes::cast_bits<__m128i>(at_most);
    __m128i const sums_one = _mm_setr_epi32(-1, -1, 0x00ffffff, 0);   // neither Key::ones nor Key::feature
#endif
#if defined(__AVX512BW__) && defined(__AVX512VL__) && defined(__BMI2__)
    // Four keys at once. Differences of 127 and more count as 127, so that their squares fit; that only lets a key pass
    // that is far.
    __m512i const wanted = _mm512_maskz_broadcast_i32x4(0xffff, wanted_one);
    __m512i const allowed = _mm512_maskz_broadcast_i32x4(0xffff, allowed_one);
    __m512i const sums = _mm512_maskz_broadcast_i32x4(0xffff, _mm_and_si128(sums_one, _mm_set1_epi8(127)));
    __m512i const one_each = _mm512_set1_epi16(1);
    __m512i const bound = _mm512_set1_epi32(near.largest);
    constexpr unsigned features = 0x8888;   // the words that are Key::feature, behind those that Key::ones is in
    for (; i < count; i += 4) {
        auto const there = static_cast<__mmask16>(count - i >= 4 ? 0xffff : (1 << 4 * (count - i)) - 1);
        __m512i const lower = _mm512_maskz_loadu_epi32(there, least + i);
        __m512i const upper = least == most ? lower : _mm512_maskz_loadu_epi32(there, most + i);
        __m512i const apart = _mm512_or_si512(_mm512_subs_epu8(lower, wanted), _mm512_subs_epu8(wanted, upper));
        __m512i const excess = _mm512_subs_epu8(apart, allowed);
        __m512i const squared = _mm512_min_epu8(apart, sums);
        __m512i terms = _mm512_madd_epi16(_mm512_maddubs_epi16(squared, squared), one_each);
        terms = _mm512_add_epi32(terms, _mm512_maskz_shuffle_epi32(0xffff, terms, _MM_PERM_BADC));
        terms = _mm512_add_epi32(terms, _mm512_maskz_shuffle_epi32(0xffff, terms, _MM_PERM_CDAB));
        unsigned const close = _mm512_mask_cmple_epi32_mask(there, terms, bound);
        unsigned const too_many_ones = _mm512_test_epi32_mask(excess, excess);
        auto const passing = static_cast<__mmask16>(close & ~(too_many_ones << 1) & features);
        _mm512_mask_storeu_epi32(out.features + found, 0xf, _mm512_maskz_compress_epi32(passing, lower));
        _mm512_mask_storeu_epi32(out.apart + found, 0xf, _mm512_maskz_compress_epi32(passing, terms));
        found += __builtin_popcount(passing);
    }
#elif defined(__SSE2__)
    for (; i < count; ++i) {
        __m128i const lower = _mm_loadu_si128(reinterpret_cast<__m128i const*>(least + i));
        __m128i const upper = _mm_loadu_si128(reinterpret_cast<__m128i const*>(most + i));
        __m128i const apart = _mm_or_si128(_mm_subs_epu8(lower, wanted_one), _mm_subs_epu8(wanted_one, upper));
        int const few_ones = _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_subs_epu8(apart, allowed_one), _mm_setzero_si128()));
        __m128i const squared = _mm_and_si128(apart, sums_one);
        __m128i const low = _mm_unpacklo_epi8(squared, _mm_setzero_si128());
        __m128i const high = _mm_unpackhi_epi8(squared, _mm_setzero_si128());
        __m128i terms = _mm_add_epi32(_mm_madd_epi16(low, low), _mm_madd_epi16(high, high));
        terms = _mm_add_epi32(terms, _mm_shuffle_epi32(terms, 0x4e));
        terms = _mm_add_epi32(terms, _mm_shuffle_epi32(terms, 0xb1));
        out.features[found] = least[i].feature;
        out.apart[found] = _mm_cvtsi128_si32(terms);
        found += (few_ones == 0xffff) & (out.apart[found] <= near.largest);
    }
#else
    for (; i < count; ++i) {
        out.features[found] = least[i].feature;
        out.apart[found] = sums_apart(near.key, least[i], most[i]);
        found += out.apart[found] <= near.largest &&
                 outside(near.key.ones, least[i].ones, most[i].ones) <= near.most_differing;
    }
#endif
    return found;
}

}   // namespace lore::exact
