#include <lore/world/reward_text.h>

#include <gtest/gtest.h>

namespace lore {
namespace {

TEST(RewardText, shows_whole_rewards_without_decimals_and_others_with_four_digits) {
    EXPECT_EQ(reward_text(5), "5");
    EXPECT_EQ(reward_text(-12), "-12");
    EXPECT_EQ(reward_text(1234567), "1234567");
    EXPECT_EQ(reward_text(-123.4321), "-123.4");
    EXPECT_EQ(reward_text(0.00012345678), "0.0001235");
    EXPECT_EQ(reward_text(-0.0), "0");
}

TEST(RewardText, has_the_unit_in_the_singular_for_one_of_what_is_counted) {
    EXPECT_EQ(reward_text(5, "balls"), "5 balls");
    EXPECT_EQ(reward_text(1, "balls"), "1 ball");
    EXPECT_EQ(reward_text(0, "balls"), "0 balls");
    EXPECT_EQ(reward_text(1, "cos"), "1 cos");
    EXPECT_EQ(reward_text(1, "loss"), "1 loss");
    EXPECT_EQ(reward_text(-123.4321, "cos"), "-123.4 cos");
    EXPECT_EQ(reward_text(3, ""), "3");
}

TEST(RewardWord, keeps_the_name_that_tables_have_always_had) {
    EXPECT_EQ(reward_word("balls"), "balls");
    EXPECT_EQ(reward_word("cos"), "reward");
}

}   // namespace
}   // namespace lore
