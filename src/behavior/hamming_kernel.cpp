// Population counts by carry-save adders (Harley and Seal; Mula, Kurz and Lemire 2018): sixteen vectors are added bit by
// bit into counters of weight 1, 2, 4, 8 and 16, and only the last is counted, once for all sixteen. No instruction for
// counting bits is needed, which neither baseline x86-64 nor AVX2 nor the AVX-512 of x86-64-v4 has for vectors.
#include "hamming_kernel.h"

#include <lore/core/lanes.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES / 2;
using Words = Lanes<std::uint64_t, width>;

struct Sum { Words carry, sum; };

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

/// Sum of bytes, a 64-bit number each. Pairs, then quadruples, then all: every field has room.
LORE_INLINE Words byte_sums(Words v) {
    v = (v & 0x00ff00ff00ff00ffu) + ((v >> 8) & 0x00ff00ff00ff00ffu);
    v = (v & 0x0000ffff0000ffffu) + ((v >> 16) & 0x0000ffff0000ffffu);
    return (v & 0x00000000ffffffffu) + (v >> 32);
}

static std::int64_t differing(std::uint64_t const* a, std::uint64_t const* b, int words) {
    Words ones{}, twos{}, fours{}, eights{}, sixteen_bytes{};
    int held = 0;
    auto const next = [&](int k) __attribute__((always_inline)) { return lanes::load<Words>(a + k * width) ^ lanes::load<Words>(b + k * width); };
    auto const two = [&](int k) __attribute__((always_inline)) {
        Sum const s = add(ones, next(k), next(k + 1));
        ones = s.sum;
        return s.carry;
    };
    auto const four = [&](int k) __attribute__((always_inline)) {
        Words const low = two(k), high = two(k + 2);
        Sum const s = add(twos, low, high);
        twos = s.sum;
        return s.carry;
    };
    auto const eight = [&](int k) __attribute__((always_inline)) {
        Words const low = four(k), high = four(k + 4);
        Sum const s = add(fours, low, high);
        fours = s.sum;
        return s.carry;
    };
    Words total{};
    for (int done = 0; done < words; done += 16 * width, a += 16 * width, b += 16 * width) {
        Words const low = eight(0), high = eight(8);
        Sum const s = add(eights, low, high);
        eights = s.sum;
        sixteen_bytes += byte_counts(s.carry);
        if (++held == 31) {   // 31 * 8 < 256
            total += byte_sums(sixteen_bytes);
            sixteen_bytes = Words{};
            held = 0;
        }
    }
    total += byte_sums(sixteen_bytes);
    Words const rest = byte_counts(ones) + (byte_counts(twos) << 1) + (byte_counts(fours) << 2) + (byte_counts(eights) << 3);   // <= 120
    total = (total << 4) + byte_sums(rest);
    std::int64_t count = 0;
    for (int lane = 0; lane < width; ++lane) count += static_cast<std::int64_t>(total[lane]);
    return count;
}

} // namespace

extern HammingKernel const hamming;
HammingKernel const hamming{differing};

} // namespace lore::LORE_ISA_NAMESPACE
