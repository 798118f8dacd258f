#include <lore/world/values.h>

#include <gmock/gmock.h>

#include <limits>
#include <vector>

namespace lore {
namespace {

using ::testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Two sensors, the second binary; two lives; positions in 3 x 4.
WorldFacts facts() {
    WorldFacts facts;
    facts.sensors = {{"angle", false}, {"flag", true}};
    facts.outcome_size = 2;
    facts.width = 3;
    facts.height = 4;
    return facts;
}

std::string why(std::vector<float> const& sensors, std::vector<float> const& x = {0, 3},
                std::vector<float> const& y = {4, 0}) {
    return why_senses_are_wrong(facts(), sensors, x, y);
}

TEST(Senses, lie_in_the_unit_interval_ends_included) {
    EXPECT_EQ(why({0, 1, 1, 0}), "");
    EXPECT_EQ(why({0.5f, -0.0f, 0, -0.0f}), "");
    EXPECT_EQ(why({0, 1.25f, 1, 0}), "sensor 'angle' of life 1 is 1.25, and sensors lie in [0, 1]");
    EXPECT_THAT(why({-0.001f, 1, 1, 0}), HasSubstr("life 0 is -0.001"));
    EXPECT_THAT(why({0, nan, 1, 0}), HasSubstr("sensor 'angle' of life 1 is NaN"));
    EXPECT_THAT(why({infinity, 0, 1, 0}), HasSubstr("inf"));
}

TEST(Senses, of_binary_channels_are_zero_or_one) {
    EXPECT_EQ(why({0, 1, 0.5f, 0}), "binary sensor 'flag' of life 0 is 0.5, and only 0 and 1 are binary");
    EXPECT_THAT(why({0, 1, 0, nan}), HasSubstr("flag"));
}

TEST(Senses, have_positions_within_the_world) {
    EXPECT_EQ(why({0, 1, 1, 0}, {0, 3.5f}), "x of life 1 is 3.5, and positions lie in 0 .. width = 3");
    EXPECT_THAT(why({0, 1, 1, 0}, {0, 0}, {-1, 0}), HasSubstr("y of life 0 is -1"));
    EXPECT_THAT(why({0, 1, 1, 0}, {0, nan}), HasSubstr("x of life 1 is NaN"));
}

TEST(Results, have_finite_rewards_and_lives_that_stay_over) {
    using Bytes = std::vector<unsigned char>;
    auto const why = [](std::vector<float> const& rewards, Bytes const& over, Bytes const& before) {
        return why_results_are_wrong(rewards, over, before);
    };
    EXPECT_EQ(why({-1e30f, 0}, {0, 1}, {0, 1}), "");
    EXPECT_THAT(why({1, infinity}, {0, 0}, {0, 0}), HasSubstr("the reward of life 1 is inf"));
    EXPECT_THAT(why({1, 1}, {0, 2}, {0, 0}), HasSubstr("over of life 1 is 2"));
    EXPECT_THAT(why({0, 0}, {0, 0}, {1, 0}), HasSubstr("life 0 is not over, and was before"));
    EXPECT_THAT(why({0.5f, 0}, {1, 0}, {1, 0}), HasSubstr("the reward of life 0 is 0.5, and the life was over before"));
}

TEST(Outcomes, are_finite) {
    EXPECT_EQ(why_outcomes_are_wrong(facts(), std::vector<float>{-5, 1e9f, 0, 1}, 2), "");
    EXPECT_THAT(why_outcomes_are_wrong(facts(), std::vector<float>{0, 0, 0, nan}, 2),
                HasSubstr("outcome 1 of life 1 is NaN"));
}

}   // namespace
}   // namespace lore
