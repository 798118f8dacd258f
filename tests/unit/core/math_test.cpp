#include <lore/core/math.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace lore;

namespace {

/// Error of a float in units in the last place of the exact value.
double ulps(float got, double exact) {
    int exponent = 0;
    std::frexp(exact, &exponent);
    return std::abs(got - exact) / std::ldexp(1.0, exponent - 24);
}

template <int W>
void expect_lanes_equal_scalar(float low, float high, int count) {
    using V = Lanes<float, W>;
    for (int i = 0; i < count; ++i) {
        V x{};
        for (int lane = 0; lane < W; ++lane)
            x[lane] = low + (high - low) * static_cast<float>((i * W + lane) % 9973) / 9973.0f +
                      static_cast<float>(i) * 1e-5f;
        V const e = math::exp<V>(x);
        auto const sc = math::sincos<V>(x);
        for (int lane = 0; lane < W; ++lane) {
            float const one = x[lane];
            ASSERT_EQ(std::bit_cast<std::uint32_t>(math::exp<float>(one)),
                      std::bit_cast<std::uint32_t>(static_cast<float>(e[lane])))
                << one;
            auto const both = math::sincos<float>(one);
            ASSERT_EQ(std::bit_cast<std::uint32_t>(both.sin),
                      std::bit_cast<std::uint32_t>(static_cast<float>(sc.sin[lane])))
                << one;
            ASSERT_EQ(std::bit_cast<std::uint32_t>(both.cos),
                      std::bit_cast<std::uint32_t>(static_cast<float>(sc.cos[lane])))
                << one;
        }
    }
}

}   // namespace

TEST(Exp, is_within_two_ulp_of_libm) {
    double worst = 0;
    for (float x = -87.0f; x <= 88.0f; x += 0.0007f)
        worst = std::max(worst, ulps(math::exp(x), std::exp(static_cast<double>(x))));
    for (float x = -1.0f; x <= 1.0f; x += 0.00001f)
        worst = std::max(worst, ulps(math::exp(x), std::exp(static_cast<double>(x))));
    EXPECT_LT(worst, 2.0);
    EXPECT_EQ(math::exp(0.0f), 1.0f);
}

TEST(Exp, saturates_instead_of_overflowing) {
    float const infinity = std::numeric_limits<float>::infinity();
    for (float x : {88.0f, 89.0f, 1300.0f, std::numeric_limits<float>::max(), infinity})
        EXPECT_EQ(math::exp(x), math::exp(88.0f));
    for (float x : {-87.0f, -88.0f, -1300.0f, std::numeric_limits<float>::lowest(), -infinity})
        EXPECT_EQ(math::exp(x), math::exp(-87.0f));
    EXPECT_TRUE(std::isfinite(math::exp(88.0f)));
    EXPECT_TRUE(std::isnormal(math::exp(-87.0f)));
}

TEST(SinCos, is_within_two_ulp_of_libm_for_headings) {
    double worst = 0;
    for (float x = -math::pi; x <= math::pi; x += 0.00003f) {
        auto const both = math::sincos(x);
        worst = std::max(worst, ulps(both.sin, std::sin(static_cast<double>(x))));
        worst = std::max(worst, ulps(both.cos, std::cos(static_cast<double>(x))));
    }
    EXPECT_LT(worst, 2.0);
    EXPECT_EQ(math::sincos(0.0f).sin, 0.0f);
    EXPECT_EQ(math::sincos(0.0f).cos, 1.0f);
}

TEST(SinCos, errs_by_less_than_1e_7_up_to_1000) {
    double worst = 0;
    for (float x = -1000.0f; x <= 1000.0f; x += 0.0033f) {
        auto const both = math::sincos(x);
        worst = std::max(worst, std::abs(both.sin - std::sin(static_cast<double>(x))));
        worst = std::max(worst, std::abs(both.cos - std::cos(static_cast<double>(x))));
    }
    EXPECT_LT(worst, 1e-7);
}

TEST(Math, gives_the_same_bits_in_lanes_and_alone) {
    expect_lanes_equal_scalar<4>(-95.0f, 95.0f, 6000);
    expect_lanes_equal_scalar<8>(-4.0f, 4.0f, 6000);
    expect_lanes_equal_scalar<16>(-95.0f, 95.0f, 3000);
}

TEST(Log, is_within_two_ulp_of_libm) {
    double worst = 0;
    auto check = [&](double x) {
        double const exact = std::log(x);
        if (exact == 0) EXPECT_EQ(math::log(x), 0.0);
        else
            worst = std::max(worst, std::abs(math::log(x) - exact) /
                                        (std::nextafter(std::abs(exact), 1e300) - std::abs(exact)));
    };
    for (int i = 1; i <= 100000; ++i) check(i);
    for (int i = 1; i <= 4000; ++i) check(i / 4000.0);
    for (double x = 1e-300; x < 1e300; x *= 1.37) check(x);
    EXPECT_LE(worst, 2.0);
}
