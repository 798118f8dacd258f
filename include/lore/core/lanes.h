#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// Marks every function that kernels share with plain code. A kernel's source is compiled once per instruction set, and
/// the linker keeps one copy of each out-of-line inline function: it might be the AVX-512 one, and baseline code would
/// die of it. A function that is never out of line has no copy to be mixed up.
#define LORE_INLINE [[gnu::always_inline]] inline

namespace lore {

template <class T, int W>
struct LanesOf {
    typedef T type __attribute__((vector_size(sizeof(T) * W)));
};

/// W values of T that are computed on at once: a vector of the GCC/clang extension, with its operators + - * / and
/// comparisons, which give a mask of W integers, 0 or -1. W should be the native width of the instruction set
/// (LORE_LANES): g++ turns wider vectors into code ten times slower.
template <class T, int W>
using Lanes = typename LanesOf<T, W>::type;

/// What the templates of core/math.h need to know of float and of Lanes<float, W>.
template <class F>
struct LaneTraits {
    static constexpr int width = sizeof(F) / sizeof(float);
    using Int = Lanes<std::int32_t, width>;
    using Mask = Int;
};
template <>
struct LaneTraits<float> {
    static constexpr int width = 1;
    using Int = std::int32_t;
    using Mask = bool;
};
template <class F>
using IntOf = typename LaneTraits<F>::Int;
template <class F>
using MaskOf = typename LaneTraits<F>::Mask;

/// Operations on lanes that the operators lack; each means the same for a scalar and for every lane of a vector.
/// The AVX-512 intrinsics are taken with a full mask, because g++ 12 warns of its own unmasked ones.
namespace lanes {

template <class To, class From>
LORE_INLINE To cast_bits(From const& from) {
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

template <class V, class T>
LORE_INLINE V load(T const* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
template <class V, class T>
LORE_INLINE void store(T* to, V const& v) {
    std::memcpy(to, &v, sizeof v);
}

/// All lanes equal to `value`.
template <class V, class T>
LORE_INLINE V all_of(T value) {
    if constexpr (std::is_arithmetic_v<V>) return static_cast<V>(value);
    else return value - V{};
}

/// mask ? a : b, lane by lane.
template <class M, class V>
LORE_INLINE V select(M const& mask, V const& a, V const& b) {
    return mask ? a : b;
}

/// sign < 0 ? a : b, lane by lane: asks the sign bit alone.
template <class I, class V>
LORE_INLINE V select_negative(I const& sign, V const& a, V const& b) {
#if defined(__AVX512DQ__)
    if constexpr (std::is_same_v<V, Lanes<float, 16>>)
        return (V)_mm512_mask_mov_ps((__m512)b, _mm512_movepi32_mask((__m512i)sign), (__m512)a);
#endif
#if defined(__AVX__)
    if constexpr (std::is_same_v<V, Lanes<float, 8>>) return (V)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)sign);
#endif
    return sign < 0 ? a : b;
}

/// a & (b | c); one instruction of AVX-512, which g++ 12 does not find by itself.
template <class I>
LORE_INLINE I and_either(I const& a, I const& b, I const& c) {
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<I, Lanes<std::int32_t, 16>>)
        return (I)_mm512_ternarylogic_epi32((__m512i)a, (__m512i)b, (__m512i)c, 0xe0);
#endif
    return a & (b | c);
}

/// a < b ? a : b; b where either is NaN.
template <class V>
LORE_INLINE V min(V const& a, V const& b) {
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<V, Lanes<float, 16>>) return (V)_mm512_maskz_min_ps(0xffff, (__m512)a, (__m512)b);
#endif
#if defined(__AVX__)
    if constexpr (std::is_same_v<V, Lanes<float, 8>>) return (V)_mm256_min_ps((__m256)a, (__m256)b);
#endif
#if defined(__SSE2__)
    if constexpr (std::is_same_v<V, Lanes<float, 4>>) return (V)_mm_min_ps((__m128)a, (__m128)b);
#endif
    return a < b ? a : b;
}

/// a > b ? a : b; b where either is NaN.
template <class V>
LORE_INLINE V max(V const& a, V const& b) {
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<V, Lanes<float, 16>>) return (V)_mm512_maskz_max_ps(0xffff, (__m512)a, (__m512)b);
#endif
#if defined(__AVX__)
    if constexpr (std::is_same_v<V, Lanes<float, 8>>) return (V)_mm256_max_ps((__m256)a, (__m256)b);
#endif
#if defined(__SSE2__)
    if constexpr (std::is_same_v<V, Lanes<float, 4>>) return (V)_mm_max_ps((__m128)a, (__m128)b);
#endif
    return a > b ? a : b;
}

template <class F>
LORE_INLINE F abs(F const& x) {
    return cast_bits<F>(cast_bits<IntOf<F>>(x) & 0x7fffffff);
}

/// Correctly rounded, as the scalar square root.
template <class F>
LORE_INLINE F sqrt(F const& x) {
    if constexpr (std::is_same_v<F, float>) return __builtin_sqrtf(x);
    else if constexpr (std::is_same_v<F, double>) return __builtin_sqrt(x);
    else {
#if defined(__AVX512F__)
        if constexpr (std::is_same_v<F, Lanes<float, 16>>) return (F)_mm512_maskz_sqrt_ps(0xffff, (__m512)x);
        if constexpr (std::is_same_v<F, Lanes<double, 8>>) return (F)_mm512_maskz_sqrt_pd(0xff, (__m512d)x);
#endif
#if defined(__AVX__)
        if constexpr (std::is_same_v<F, Lanes<float, 8>>) return (F)_mm256_sqrt_ps((__m256)x);
        if constexpr (std::is_same_v<F, Lanes<double, 4>>) return (F)_mm256_sqrt_pd((__m256d)x);
#endif
#if defined(__SSE2__)
        if constexpr (std::is_same_v<F, Lanes<float, 4>>) return (F)_mm_sqrt_ps((__m128)x);
        if constexpr (std::is_same_v<F, Lanes<double, 2>>) return (F)_mm_sqrt_pd((__m128d)x);
#endif
        F root{};
        for (std::size_t lane = 0; lane < sizeof(F) / sizeof x[0]; ++lane) root[lane] = sqrt(x[lane]);
        return root;
    }
}

/// Towards zero. Precondition: |x| < 2^31.
template <class F>
LORE_INLINE IntOf<F> truncate(F const& x) {
    if constexpr (std::is_same_v<F, float>) return static_cast<std::int32_t>(x);
    else return __builtin_convertvector(x, IntOf<F>);
}

/// The nearest integer, halves to even, as float and as integer at the cost of two additions. Precondition: |x| < 2^22.
template <class F>
struct Rounded {
    F value;
    IntOf<F> integer;
};
template <class F>
LORE_INLINE Rounded<F> round(F const& x) {
    constexpr float magic = 12582912.0f;   // 1.5 * 2^23: the sum's last mantissa bit is worth 1
    F const sum = x + magic;
    return {sum - magic, cast_bits<IntOf<F>>(sum) - 0x4b400000};
}

/// Bit i of the result: lane i of the mask.
template <class M>
LORE_INLINE std::uint32_t mask_bits(M const& mask) {
    if constexpr (std::is_same_v<M, bool>) return mask ? 1u : 0u;
    else {
        constexpr int width = sizeof(M) / sizeof(std::int32_t);
#if defined(__AVX512DQ__)
        if constexpr (width == 16) return static_cast<std::uint32_t>(_mm512_movepi32_mask((__m512i)mask));
#endif
#if defined(__AVX__)
        if constexpr (width == 8) return static_cast<std::uint32_t>(_mm256_movemask_ps((__m256)mask));
#endif
#if defined(__SSE2__)
        if constexpr (width == 4) return static_cast<std::uint32_t>(_mm_movemask_ps((__m128)mask));
#endif
        std::int32_t held[width];
        __builtin_memcpy(held, &mask, sizeof held);
        std::uint32_t bits = 0;
        for (int lane = 0; lane < width; ++lane) bits |= (held[lane] != 0 ? 1u : 0u) << lane;
        return bits;
    }
}

template <class M>
LORE_INLINE bool any(M const& mask) {
    return mask_bits(mask) != 0;
}
template <class M>
LORE_INLINE bool all(M const& mask) {
    if constexpr (std::is_same_v<M, bool>) return mask;
    else return mask_bits(mask) == (1ull << (sizeof(M) / sizeof(std::int32_t))) - 1;
}

/// The lanes' integers or-ed together.
template <class I>
LORE_INLINE std::uint32_t reduce_or(I const& v) {
    if constexpr (std::is_same_v<I, std::int32_t>) return static_cast<std::uint32_t>(v);
    else {
        constexpr int width = sizeof(I) / sizeof(std::int32_t);
        if constexpr (width > 4) {
            using Half = Lanes<std::int32_t, width / 2>;
            char const* const lanes = reinterpret_cast<char const*>(&v);
            return reduce_or(Half(load<Half>(lanes) | load<Half>(lanes + sizeof(Half))));
        } else {
            auto const pairs = cast_bits<Lanes<std::int64_t, 2>>(v);
            std::int64_t const both = pairs[0] | pairs[1];
            return static_cast<std::uint32_t>(both | both >> 32);
        }
    }
}

/// table[index], lane by lane; T is float or std::int32_t.
template <class T, class I>
LORE_INLINE auto gather(T const* table, I const& index) {
    if constexpr (std::is_same_v<I, std::int32_t>) return table[index];
    else {
        constexpr int width = sizeof(I) / sizeof(std::int32_t);
        using V = Lanes<T, width>;
#if defined(__AVX512F__)
        if constexpr (width == 16) return (V)_mm512_mask_i32gather_epi32(__m512i{}, 0xffff, (__m512i)index, table, 4);
        else
#endif
#if defined(__AVX2__)
            if constexpr (width == 8)
            return (V)_mm256_i32gather_epi32(reinterpret_cast<int const*>(table), (__m256i)index, 4);
        else
#endif
        {
            V v{};
            for (int lane = 0; lane < width; ++lane) v[lane] = table[index[lane]];
            return v;
        }
    }
}

/// The two halves of 64-bit words, lane by lane.
template <class I>
struct WordPair {
    I low, high;
};

/// Words number `index` of a table of 64-bit words (two 32-bit halves each, low half first).
template <class I>
LORE_INLINE WordPair<I> gather_pairs(void const* table, I const& index) {
    constexpr int width = sizeof(I) / sizeof(std::int32_t);
#if defined(__AVX512F__)
    if constexpr (width == 16) {
        // The indices have names of their own because with clang the intrinsics are macros.
        using Half = Lanes<std::int32_t, 8>;
        char const* const from = reinterpret_cast<char const*>(&index);
        __m256i const first = (__m256i)load<Half>(from), second = (__m256i)load<Half>(from + sizeof(Half));
        __m512i const a = _mm512_mask_i32gather_epi64(__m512i{}, 0xff, first, table, 8);
        __m512i const b = _mm512_mask_i32gather_epi64(__m512i{}, 0xff, second, table, 8);
        I const even{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30};
        return {(I)_mm512_permutex2var_epi32(a, (__m512i)even, b),
                (I)_mm512_permutex2var_epi32(a, (__m512i)(even + 1), b)};
    } else
#endif
#if defined(__AVX2__)
        if constexpr (width == 8) {
        auto const* const words = static_cast<long long const*>(table);
        __m256i const a = _mm256_i32gather_epi64(words, _mm256_castsi256_si128((__m256i)index), 8);
        __m256i const b = _mm256_i32gather_epi64(words, _mm256_extracti128_si256((__m256i)index, 1), 8);
        __m256 const low = _mm256_shuffle_ps((__m256)a, (__m256)b, 0x88),
                     high = _mm256_shuffle_ps((__m256)a, (__m256)b, 0xdd);
        return {(I)_mm256_permute4x64_epi64((__m256i)low, 0xd8), (I)_mm256_permute4x64_epi64((__m256i)high, 0xd8)};
    } else
#endif
    {
        WordPair<I> pair{};
        for (int lane = 0; lane < width; ++lane) {
            auto const word = load<Lanes<std::int32_t, 2>>(static_cast<char const*>(table) +
                                                           8 * static_cast<std::int64_t>(index[lane]));
            pair.low[lane] = word[0];
            pair.high[lane] = word[1];
        }
        return pair;
    }
}

}   // namespace lanes
}   // namespace lore
