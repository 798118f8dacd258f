#include <lore/statistics/holm.h>

#include <lore/core/error.h>

#include <gtest/gtest.h>

#include <limits>

using namespace lore;
using Values = std::vector<double>;

TEST(Holm, multiplies_the_smallest_by_the_number_of_tests_and_never_decreases) {
    // Sorted: 0.01 x 4 = 0.04, 0.02 x 3 = 0.06, 0.03 x 2 = 0.06, 0.04 x 1 = 0.04 raised to 0.06.
    Values const adjusted = holm_adjusted(Values{0.04, 0.01, 0.03, 0.02});
    EXPECT_DOUBLE_EQ(adjusted[0], 0.06);
    EXPECT_DOUBLE_EQ(adjusted[1], 0.04);
    EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
    EXPECT_DOUBLE_EQ(adjusted[3], 0.06);
}

TEST(Holm, stops_at_one) { EXPECT_EQ(holm_adjusted(Values{0.6, 0.7}), (Values{1, 1})); }

TEST(Holm, leaves_a_single_test_and_an_empty_family_alone) {
    EXPECT_EQ(holm_adjusted(Values{0.3}), Values{0.3});
    EXPECT_TRUE(holm_adjusted(Values{}).empty());
}

TEST(Holm, refuses_what_is_no_probability) {
    EXPECT_THROW(holm_adjusted(Values{1.5}), Error);
    EXPECT_THROW(holm_adjusted(Values{std::numeric_limits<double>::quiet_NaN()}), Error);
}
