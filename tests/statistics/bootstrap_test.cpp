#include <lore/statistics/bootstrap.h>

#include <lore/core/error.h>
#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace lore;
using Curves = std::vector<std::vector<double>>;

TEST(Bootstrap, band_has_no_width_for_one_curve_or_equal_curves) {
    MeanBand const one = bootstrap_mean_band(Curves{{1, 2, 3}});
    EXPECT_EQ(one.mean, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(one.low, one.mean);
    EXPECT_EQ(one.high, one.mean);
    MeanBand const equal = bootstrap_mean_band(Curves{{4}, {4}, {4}});
    EXPECT_EQ(equal.low, equal.high);
}

TEST(Bootstrap, band_contains_the_mean_and_stays_within_the_curves) {
    Stream rng{3, Purpose::test};
    Curves curves(30, std::vector<double>(5));
    for (auto& curve : curves) for (double& x : curve) x = rng.below(9);
    MeanBand const band = bootstrap_mean_band(curves);
    for (std::size_t c = 0; c < 5; ++c) {
        EXPECT_LT(band.low[c], band.mean[c]);
        EXPECT_GT(band.high[c], band.mean[c]);
        EXPECT_GE(band.low[c], 0);
        EXPECT_LE(band.high[c], 8);
    }
}

TEST(Bootstrap, band_is_as_wide_as_the_normal_theory_says_for_many_curves) {
    // Uniform values: standard error of the mean of n is sqrt(1/12/n); the band spans 2 x 1.96 of them.
    Stream rng{4, Purpose::test};
    Curves curves(200, std::vector<double>(1));
    for (auto& curve : curves) curve[0] = rng.uniform();
    MeanBand const band = bootstrap_mean_band(curves);
    EXPECT_NEAR(band.high[0] - band.low[0], 2 * 1.96 * std::sqrt(1.0 / 12 / 200), 0.012);
}

TEST(Bootstrap, band_is_the_same_every_time_and_another_for_another_seed) {
    Stream rng{5, Purpose::test};
    Curves curves(10, std::vector<double>(3));
    for (auto& curve : curves) for (double& x : curve) x = rng.uniform();
    EXPECT_EQ(bootstrap_mean_band(curves).low, bootstrap_mean_band(curves).low);
    EXPECT_NE(bootstrap_mean_band(curves).low, bootstrap_mean_band(curves, {.seed = 2}).low);
}

TEST(Bootstrap, refuses_nothing_and_curves_of_different_lengths) {
    EXPECT_THROW(bootstrap_mean_band(Curves{}), Error);
    EXPECT_THROW(bootstrap_mean_band(Curves{{1}, {1, 2}}), Error);
}
