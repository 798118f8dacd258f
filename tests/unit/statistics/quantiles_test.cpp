#include <lore/statistics/quantiles.h>

#include <lore/core/error.h>
#include <statistics/reference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace lore;
using Sample = std::vector<double>;

TEST(Quantiles, agree_with_numpy) {
    for (auto const& reference : test::reference_cases()) {
        EXPECT_DOUBLE_EQ(quantile(reference.first, 0.25), reference.lower_quartile);
        EXPECT_DOUBLE_EQ(quantile(reference.first, 0.5), reference.median);
        EXPECT_DOUBLE_EQ(quantile(reference.first, 0.75), reference.upper_quartile);
    }
}

TEST(Quantiles, interpolate_between_neighbors) {
    EXPECT_EQ(quantile(Sample{4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_EQ(quantile(Sample{1, 2, 3, 4}, 0.25), 1.75);
    EXPECT_EQ(quantile(Sample{7}, 0.9), 7);
    EXPECT_EQ(quantile(Sample{1, 2}, 1), 2);
}

TEST(FiveNumbers, end_their_whiskers_at_values_within_one_and_a_half_boxes) {
    FiveNumbers const box = five_numbers(Sample{1, 2, 3, 4, 100});
    EXPECT_EQ(box.median, 3);
    EXPECT_EQ(box.lower_quartile, 2);
    EXPECT_EQ(box.upper_quartile, 4);
    EXPECT_EQ(box.low_whisker, 1);
    EXPECT_EQ(box.high_whisker, 4);   // 100 lies beyond 4 + 3
}

TEST(FiveNumbers, collapse_where_all_values_are_equal) {
    FiveNumbers const box = five_numbers(Sample(9, 5));
    EXPECT_EQ(box.low_whisker, 5);
    EXPECT_EQ(box.high_whisker, 5);
}

TEST(Moments, are_those_of_a_small_sample) {
    EXPECT_EQ(mean(Sample{2, 4, 9}), 5);
    EXPECT_DOUBLE_EQ(standard_deviation(Sample{2, 4, 9}), std::sqrt((9.0 + 1 + 16) / 2));
    EXPECT_EQ(standard_deviation(Sample{3}), 0);
}

TEST(Quantiles, refuse_an_empty_sample_and_a_nan) {
    EXPECT_THROW(quantile(Sample{}, 0.5), Error);
    EXPECT_THROW(mean(Sample{}), Error);
    EXPECT_THROW(quantile(Sample{1, std::numeric_limits<double>::quiet_NaN()}, 0.5), Error);
}
