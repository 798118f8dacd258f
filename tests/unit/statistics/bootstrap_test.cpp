#include <lore/statistics/bootstrap.h>

#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/statistics/mann_whitney.h>

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
    for (auto& curve : curves)
        for (double& x : curve) x = rng.below(9);
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
    for (auto& curve : curves)
        for (double& x : curve) x = rng.uniform();
    EXPECT_EQ(bootstrap_mean_band(curves).low, bootstrap_mean_band(curves).low);
    EXPECT_NE(bootstrap_mean_band(curves).low, bootstrap_mean_band(curves, {.seed = 2}).low);
}

TEST(Bootstrap, refuses_nothing_and_curves_of_different_lengths) {
    EXPECT_THROW(bootstrap_mean_band(Curves{}), Error);
    EXPECT_THROW(bootstrap_mean_band(Curves{{1}, {1, 2}}), Error);
}

TEST(Bootstrap, interval_of_an_effect_size_holds_it_and_repeats) {
    std::vector<double> const first{1, 2, 2, 3, 5, 6, 6, 7}, second{0, 1, 2, 3, 3, 4, 5, 8};
    Interval const interval = bootstrap_a12(first, second);
    double const effect = vargha_delaney_a12(first, second);
    EXPECT_LT(interval.low, effect);
    EXPECT_GT(interval.high, effect);
    EXPECT_EQ(bootstrap_a12(first, second).low, interval.low);
    // Seen from the other side it is nearly the mirror image: other draws of the same kind.
    EXPECT_NEAR(bootstrap_a12(second, first).low, 1 - interval.high, 0.05);
}

TEST(Bootstrap, interval_of_a_difference_of_means_holds_it_and_repeats) {
    std::vector<double> const first{5, 7, 9, 6, 8}, second{1, 3, 2, 4, 2.5};
    Interval const interval = bootstrap_mean_difference(first, second);
    EXPECT_LT(interval.low, 4.5);
    EXPECT_GT(interval.high, 4.5);
    EXPECT_GT(interval.low, 1) << "no draw of the first has a mean below 5, none of the second above 4";
    EXPECT_LT(interval.high, 8);
    EXPECT_EQ(bootstrap_mean_difference(first, second).low, interval.low);
    std::vector<double> const equal{3, 3, 3};
    EXPECT_EQ(bootstrap_mean_difference(equal, equal).low, 0);
    EXPECT_EQ(bootstrap_mean_difference(equal, equal).high, 0);
    EXPECT_THROW(bootstrap_mean_difference(std::vector<double>{}, equal), Error);
}

TEST(Bootstrap, interval_of_an_effect_size_has_no_width_where_samples_do_not_overlap) {
    std::vector<double> const low{1, 2, 3}, high{4, 5, 6};
    EXPECT_EQ(bootstrap_a12(low, high).high, 0);
    EXPECT_EQ(bootstrap_a12(high, low).low, 1);
    EXPECT_THROW(bootstrap_a12(std::vector<double>{}, high), Error);
}

TEST(Bootstrap, interval_of_an_effect_size_is_as_wide_as_theory_says) {
    // Two samples of one continuous distribution: the variance of A12 is (n + m + 1) / (12 n m).
    Stream rng{5, Purpose::test};
    std::vector<double> first(150), second(150);
    for (auto* sample : {&first, &second})
        for (double& x : *sample) x = rng.uniform();
    Interval const interval = bootstrap_a12(first, second);
    double const expected = 2 * 1.96 * std::sqrt(301.0 / (12.0 * 150 * 150));
    EXPECT_NEAR(interval.high - interval.low, expected, 0.1 * expected);
}
