#pragma once

#include "exact_kernel.h"

#include <lore/core/lanes.h>

#include <cstdint>
#include <cstring>

// How keys lie in groups, and which of them are so near to one that their features may match (exact_shape.h, bounds 1
// and 3).
namespace lore::exact {

LORE_INLINE void put_numbers(KeyNumbers& numbers, int lane, Key const& key) {
    for (int part = 0; part < key_parts; ++part)
        std::memcpy(numbers.of[part][lane], reinterpret_cast<std::uint8_t const*>(&key) + part * 4, 4);
}

/// A key of no feature.
LORE_INLINE Key numbers_at(KeyNumbers const& numbers, int lane) {
    Key key{{}, 0, -1};
    for (int part = 0; part < key_parts; ++part)
        std::memcpy(reinterpret_cast<std::uint8_t*>(&key) + part * 4, numbers.of[part][lane], 4);
    return key;
}

/// Lane i: bit i.
using LaneMask = std::uint32_t;

/// Those of a group that are in the bucket.
LORE_INLINE LaneMask lanes_of(Bucket bucket, std::uint32_t group) {
    std::uint32_t const begin = group * key_group, end = bucket.start + bucket.count;
    LaneMask const until = end >= begin + key_group ? 0xffffu : (1u << (end - begin)) - 1;
    return bucket.start > begin ? until & (0xffffu << (bucket.start - begin)) : until;
}

/// Which keys are near: those whose sums differ by squares that add up to at most `largest`, and whose ones by at most
/// `most_differing`.
struct NearKeys {
    Key key;
    int most_differing;
    std::int32_t largest;
};

/// Where near_keys writes names and how far their keys are apart, in squares; each has room for all and spare_keys
/// more.
struct NearNames {
    std::int32_t *names, *apart;
    LORE_INLINE NearNames from(int place) const { return {names + place, apart + place}; }
};

/// How far a byte is from a range.
LORE_INLINE int outside(std::uint8_t byte, std::uint8_t least, std::uint8_t most) {
    return byte < least ? least - byte : byte > most ? byte - most : 0;
}

/// Writes the names of those lanes whose keys are near, or may be near if they lie between `least` and `most`, and
/// returns how many. `names`: of the lanes; null: they are numbered from `first`.
LORE_INLINE int near_keys(KeyNumbers const& least, KeyNumbers const& most, LaneMask lanes, std::int32_t const* names,
                          std::uint32_t first, NearKeys const& near, NearNames out) {
#if defined(__SSE2__)
    std::int32_t wanted_parts[key_parts];
    std::memcpy(wanted_parts, &near.key, sizeof wanted_parts);
    constexpr std::int32_t without_ones = 0x00ffffff, every_other = 0x00ff00ff;
#endif
#if defined(__AVX512BW__) && defined(__AVX512VL__)
    __m512i sums = _mm512_setzero_si512(), ones = sums;
    for (int part = 0; part < key_parts; ++part) {
        __m512i const wanted = _mm512_set1_epi32(wanted_parts[part]);
        auto const lower = lanes::load<__m512i>(&least.of[part]), upper = lanes::load<__m512i>(&most.of[part]);
        __m512i apart = _mm512_or_si512(_mm512_subs_epu8(lower, wanted), _mm512_subs_epu8(wanted, upper));
        if (part == key_parts - 1) {
            ones = _mm512_maskz_srli_epi32(0xffff, apart, 24);
            apart = _mm512_and_si512(apart, _mm512_set1_epi32(without_ones));
        }
        __m512i const even = _mm512_and_si512(apart, _mm512_set1_epi32(every_other));
        __m512i const odd = _mm512_maskz_srli_epi16(~__mmask32{0}, apart, 8);
        sums = _mm512_add_epi32(sums, _mm512_add_epi32(_mm512_madd_epi16(even, even), _mm512_madd_epi16(odd, odd)));
    }
    __mmask16 const few_ones =
        _mm512_mask_cmple_epi32_mask(static_cast<__mmask16>(lanes), ones, _mm512_set1_epi32(near.most_differing));
    __mmask16 const passing = _mm512_mask_cmple_epi32_mask(few_ones, sums, _mm512_set1_epi32(near.largest));
    __m512i const numbers = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    __m512i const named = names != nullptr
                              ? lanes::load<__m512i>(names)
                              : _mm512_add_epi32(_mm512_set1_epi32(static_cast<std::int32_t>(first)), numbers);
    lanes::store(out.names, _mm512_maskz_compress_epi32(passing, named));
    lanes::store(out.apart, _mm512_maskz_compress_epi32(passing, sums));
    return __builtin_popcount(passing);
#else
    int found = 0;
    constexpr int at_once = 4;
    for (int lane = 0; lane < key_group; lane += at_once) {
        if ((lanes >> lane & 0xf) == 0) continue;   // of a small bucket
        std::int32_t apart[at_once], ones_apart[at_once];
#if defined(__SSE2__)
        __m128i sums = _mm_setzero_si128(), ones = sums;
        for (int part = 0; part < key_parts; ++part) {
            __m128i const wanted = _mm_set1_epi32(wanted_parts[part]);
            auto const lower = lanes::load<__m128i>(&least.of[part][lane]);
            auto const upper = lanes::load<__m128i>(&most.of[part][lane]);
            __m128i differences = _mm_or_si128(_mm_subs_epu8(lower, wanted), _mm_subs_epu8(wanted, upper));
            if (part == key_parts - 1) {
                ones = _mm_srli_epi32(differences, 24);
                differences = _mm_and_si128(differences, _mm_set1_epi32(without_ones));
            }
            __m128i const even = _mm_and_si128(differences, _mm_set1_epi32(every_other));
            __m128i const odd = _mm_srli_epi16(differences, 8);
            sums = _mm_add_epi32(sums, _mm_add_epi32(_mm_madd_epi16(even, even), _mm_madd_epi16(odd, odd)));
        }
        lanes::store(apart, sums);
        lanes::store(ones_apart, ones);
#else
        for (int i = 0; i < at_once; ++i) {
            Key const lower = numbers_at(least, lane + i), upper = numbers_at(most, lane + i);
            apart[i] = 0;
            for (int number = 0; number < key_size; ++number) {
                int const difference = outside(near.key.sums[number], lower.sums[number], upper.sums[number]);
                apart[i] += difference * difference;
            }
            ones_apart[i] = outside(near.key.ones, lower.ones, upper.ones);
        }
#endif
        for (int i = 0; i < at_once; ++i) {
            out.names[found] = names != nullptr ? names[lane + i] : static_cast<std::int32_t>(first) + lane + i;
            out.apart[found] = apart[i];
            found += static_cast<int>(lanes >> (lane + i) & 1) & static_cast<int>(apart[i] <= near.largest) &
                     static_cast<int>(ones_apart[i] <= near.most_differing);
        }
    }
    return found;
#endif
}

}   // namespace lore::exact
