#pragma once

#include <lore/core/lanes.h>

#include <bit>
#include <cstdint>

/// Our own elementary functions, because libm's differ between versions and would change results.
///
/// One template serves a float and a vector of floats and gives the same bits in both: it is made of + - * /,
/// comparisons and conversions alone, each of which IEEE 754 defines to the bit, and never of a fused multiply-add.
namespace lore::math {

inline constexpr float pi = 3.14159265358979f;

/// e^x, within 2 ulp for -87 <= x <= 88; outside it is that of the nearer bound, so never infinite, never subnormal and
/// never NaN for a finite or infinite x.
template <class F>
LORE_INLINE F exp(F const& argument) {
    F const x = lanes::max(lanes::min(argument, lanes::all_of<F>(88.0f)), lanes::all_of<F>(-87.0f));
    // x = n ln 2 + r with |r| <= ln(2)/2; ln 2 in two parts, the first short enough that its product with n is exact.
    auto const n = lanes::round<F>(x * 1.44269504f);
    F const r = (x - n.value * 0.693359375f) - n.value * -2.12194440e-4f;
    // Polynomial of Cephes' expf (Moshier) for (e^r - 1 - r) / r^2.
    F p = r * 1.9875691500e-4f + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    F const mantissa = (p * (r * r) + r) + 1.0f;
    return mantissa * lanes::cast_bits<F>((n.integer + 127) << 23);
}

template <class F>
struct SinCos {
    F sin, cos;
};

/// Sine and cosine for |x| <= 1000 [rad]: within 2 ulp for |x| <= pi, absolute error below 1e-7 beyond.
template <class F>
LORE_INLINE SinCos<F> sincos(F const& x) {
    // x = q pi/2 + r with |r| <= pi/4; pi/2 in three parts whose products with q are exact.
    auto const q = lanes::round<F>(x * 0.636619772f);
    F const r = ((x - q.value * 1.5703125f) - q.value * 4.837512969970703125e-4f) - q.value * 7.549789948768648e-8f;
    F const square = r * r;
    // Polynomials of Cephes' sinf and cosf (Moshier).
    F const sine = ((square * -1.9515295891e-4f + 8.3321608736e-3f) * square - 1.6666654611e-1f) * square * r + r;
    F const cosine =
        ((square * 2.443315711809948e-5f - 1.388731625493765e-3f) * square + 4.166664568298827e-2f) * square * square -
        square * 0.5f + 1.0f;
    auto const swapped = (q.integer & 1) != 0;
    IntOf<F> const sine_sign = (q.integer & 2) << 30;
    IntOf<F> const cosine_sign = ((q.integer + 1) & 2) << 30;
    using Int = IntOf<F>;
    return {lanes::cast_bits<F>(lanes::cast_bits<Int>(lanes::select(swapped, cosine, sine)) ^ sine_sign),
            lanes::cast_bits<F>(lanes::cast_bits<Int>(lanes::select(swapped, sine, cosine)) ^ cosine_sign)};
}

/// Natural logarithm within 2 ulp, for tables: its speed does not matter. Precondition: x positive, normal, finite.
constexpr double log(double x) {
    auto const bits = std::bit_cast<std::uint64_t>(x);
    int exponent = static_cast<int>(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
    if (m > 1.4142135623730951) {
        m *= 0.5;
        ++exponent;
    }
    // log m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...) with |s| < 0.172
    double const s = (m - 1.0) / (m + 1.0);
    double const square = s * s;
    double series = 0.0;
    for (int k = 27; k >= 3; k -= 2) series = (series + 1.0 / k) * square;
    constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;
    return exponent * ln2_high + (2.0 * s + (2.0 * s * series + exponent * ln2_low));
}

}   // namespace lore::math
