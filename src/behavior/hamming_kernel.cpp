// Bits counted without an instruction for it, which neither baseline x86-64 nor AVX2 nor the AVX-512 of x86-64-v4 has
// for vectors: carry-save adders (Harley and Seal; Mula, Kurz and Lemire 2018) turn sixteen words into counters of
// weight 1, 2, 4, 8 and 16, and only these five are counted. Compiled once per instruction set; an AVX-512 processor
// that does have the instruction (most do) counts twice as fast with it.
#include "hamming_kernel.h"

#include <lore/core/lanes.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES / 2;
using Words = Lanes<std::uint64_t, width>;

struct Sum {
    Words carry, sum;
};

LORE_INLINE Sum add(Words const& a, Words const& b, Words const& c) {
#if defined(__AVX512F__)
    if constexpr (width == 8)   // g++ 12 does not find the majority of three by itself
        return {(Words)_mm512_ternarylogic_epi64((__m512i)a, (__m512i)b, (__m512i)c, 0xe8), a ^ b ^ c};
#endif
    Words const either = a ^ b;
    return {(a & b) | (either & c), either ^ c};
}

/// Set bits of each byte, a byte each.
LORE_INLINE Words byte_counts(Words v) {
    v = v - ((v >> 1) & 0x5555555555555555u);
    v = (v & 0x3333333333333333u) + ((v >> 2) & 0x3333333333333333u);
    return (v + (v >> 4)) & 0x0f0f0f0f0f0f0f0fu;
}

/// Sum of the bytes of each word.
LORE_INLINE Words byte_sums(Words v) {
    v = (v & 0x00ff00ff00ff00ffu) + ((v >> 8) & 0x00ff00ff00ff00ffu);
    v = v + (v >> 32);
    return (v + (v >> 16)) & 0xffffu;
}

/// Set bits of sixteen words, lane by lane.
LORE_INLINE Words count_sixteen(Words const (&w)[words_per_plane]) {
    Words carries[8], ones = w[0];
    for (int k = 0; k < 7; ++k) {
        Sum const s = add(ones, w[2 * k + 1], w[2 * k + 2]);
        ones = s.sum;
        carries[k] = s.carry;
    }
    // The last word meets the ones alone.
    carries[7] = ones & w[15];
    ones ^= w[15];
    Words twos = carries[0], higher[4];
    for (int k = 0; k < 3; ++k) {
        Sum const s = add(twos, carries[2 * k + 1], carries[2 * k + 2]);
        twos = s.sum;
        higher[k] = s.carry;
    }
    higher[3] = twos & carries[7];
    twos ^= carries[7];
    Sum const low = add(higher[0], higher[1], higher[2]);
    Words const fours = low.sum ^ higher[3], carry = low.sum & higher[3];
    Words const eights = low.carry ^ carry, sixteens = low.carry & carry;
    // At most 8 (1 + 2 + 4 + 8 + 16) = 248 in a byte.
    return byte_sums(byte_counts(ones) + (byte_counts(twos) << 1) + (byte_counts(fours) << 2) +
                     (byte_counts(eights) << 3) + (byte_counts(sixteens) << 4));
}

void differing(std::uint64_t const* plane, std::uint64_t const* others, int groups, std::uint32_t* counts) {
    for (int group = 0; group < groups; ++group) {
        Words words[words_per_plane];
        for (int k = 0; k < words_per_plane; ++k) words[k] = lanes::load<Words>(others + k * width) ^ plane[k];
        lanes::store(counts, __builtin_convertvector(count_sixteen(words), Lanes<std::uint32_t, width>));
        others += words_per_plane * width;
        counts += width;
    }
}

#if defined(__AVX512F__) && LORE_LANES == 16
[[gnu::target("avx512vpopcntdq")]] void
differing_by_instruction(std::uint64_t const* plane, std::uint64_t const* others, int groups, std::uint32_t* counts) {
    for (int group = 0; group < groups; ++group) {
        Words sum{};
        for (int k = 0; k < words_per_plane; ++k)
            sum += (Words)_mm512_popcnt_epi64((__m512i)(lanes::load<Words>(others + k * width) ^ plane[k]));
        lanes::store(counts, __builtin_convertvector(sum, Lanes<std::uint32_t, width>));
        others += words_per_plane * width;
        counts += width;
    }
}
#endif

/// A template, so that the rows stay in registers and none is finished for nothing.
template <int channels>
void split_channels(std::uint16_t const* bits, std::uint64_t* planes, std::ptrdiff_t stride) {
    constexpr int steps = 2 * LORE_LANES;   // in a vector
    using Steps = Lanes<std::uint16_t, steps>;
    for (int piece = 0; piece < steps_per_plane / (16 * steps); ++piece) {
        Steps rows[16];
        for (int k = 0; k < 16; ++k) rows[k] = lanes::load<Steps>(bits + (piece * 16 + k) * steps);
        // In each lane, the 16 x 16 bits of 16 steps change rows and columns (Hacker's Delight, 7-3).
        std::uint16_t mask = 0x00ff;
        for (int j = 8; j > 0; j >>= 1, mask = static_cast<std::uint16_t>(mask ^ (mask << j))) {
            for (int k = 0; k < 16; ++k) {
                if ((k & j) != 0) continue;
                Steps const swapped = ((rows[k] >> j) ^ rows[k + j]) & mask;
                rows[k + j] ^= swapped;
                rows[k] ^= swapped << j;
            }
        }
        for (int channel = 0; channel < channels; ++channel)
            lanes::store(planes + channel * stride + piece * (steps / 4), rows[channel]);
    }
}

template <int most>
void split_up_to(std::uint16_t const* bits, std::uint64_t* planes, std::ptrdiff_t stride, int channels) {
    if constexpr (most > 1)
        if (channels < most) return split_up_to<most - 1>(bits, planes, stride, channels);
    split_channels<most>(bits, planes, stride);
}

void spread(std::uint32_t const* counts, std::int32_t const* class_of, int size, std::uint16_t* terms) {
    using Indices = Lanes<std::int32_t, LORE_LANES>;
    using Terms = Lanes<std::uint16_t, LORE_LANES>;
    auto const* const table = reinterpret_cast<std::int32_t const*>(counts);
    int j = 0;
    for (; j + LORE_LANES <= size; j += LORE_LANES)
        lanes::store(terms + j,
                     __builtin_convertvector(lanes::gather(table, lanes::load<Indices>(class_of + j)), Terms));
    for (; j < size; ++j) terms[j] = static_cast<std::uint16_t>(counts[class_of[j]]);
}

void add_terms(std::uint16_t const* terms, int size, std::uint16_t* sums) {
    constexpr int width = 2 * LORE_LANES;
    using Counts = Lanes<std::uint16_t, width>;
    int j = 0;
    for (; j + width <= size; j += width)
        lanes::store(sums + j, lanes::load<Counts>(sums + j) + lanes::load<Counts>(terms + j));
    for (; j < size; ++j) sums[j] = static_cast<std::uint16_t>(sums[j] + terms[j]);
}

}   // namespace

HammingKernel hamming(bool by_instruction) {
#if defined(__AVX512F__) && LORE_LANES == 16
    if (by_instruction && __builtin_cpu_supports("avx512vpopcntdq"))
        return {width, split_up_to<channels_of_word>, differing_by_instruction, spread, add_terms};
#endif
    static_cast<void>(by_instruction);
    return {width, split_up_to<channels_of_word>, differing, spread, add_terms};
}

}   // namespace lore::LORE_ISA_NAMESPACE
