#include <lore/knowledge/summary.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::ElementsAre;

TEST(Summarize, counts_values_in_bins_of_equal_width_the_last_one_closed) {
    double const values[]{0, 1, 1.9, 2, 4};
    ValueSummary const summary = summarize(values, 4);
    EXPECT_EQ(summary.lowest, 0);
    EXPECT_EQ(summary.highest, 4);
    EXPECT_DOUBLE_EQ(summary.mean, 8.9 / 5);
    EXPECT_THAT(summary.edges, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(summary.counts, ElementsAre(1, 2, 1, 1));
}

TEST(Summarize, has_one_bin_for_equal_values_and_none_for_no_values) {
    double const values[]{3, 3};
    EXPECT_THAT(summarize(values, 10).counts, ElementsAre(2));
    EXPECT_THAT(summarize(values, 10).edges, ElementsAre(3, 3));
    EXPECT_TRUE(summarize({}, 10).counts.empty());
}
