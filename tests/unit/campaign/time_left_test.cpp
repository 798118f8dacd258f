#include <lore/campaign/time_left.h>

#include <gtest/gtest.h>

#include <vector>

using namespace lore;

namespace {

double left(std::vector<RunPace> const& runs) { return work_left(runs); }

}   // namespace

TEST(WorkLeft, is_what_the_runs_of_the_treatment_have_shown) {
    // 2 s a generation: 30 in the second run, 100 in the third.
    EXPECT_EQ(left({{"a", 100, 100, 200, false}, {"a", 70, 100, 140, true}, {"a", 0, 100, 0, true}}), 260);
    // b is twice as fast.
    EXPECT_EQ(left({{"a", 50, 100, 100, true}, {"b", 50, 100, 50, true}}), 100 + 50);
}

TEST(WorkLeft, of_a_treatment_that_has_not_begun_is_what_any_run_has_shown) {
    EXPECT_EQ(left({{"a", 50, 50, 100, false}, {"b", 50, 50, 300, false}, {"c", 0, 10, 0, true}}), 40);
}

TEST(WorkLeft, is_nothing_where_nothing_is_to_do_or_known) {
    EXPECT_EQ(left({}), 0);
    EXPECT_EQ(left({{"a", 0, 100, 0, true}}), 0);
    EXPECT_EQ(left({{"a", 40, 100, 40, false}}), 0) << "a failed run is not waited for";
    EXPECT_EQ(left({{"a", 120, 100, 120, true}}), 0) << "a run with more generations than the plan now has";
}
