#include <lore/world/channels.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace lore {
namespace {

Channels const robot{{{"range", false}, {"bumper", true}}, {{"wheel", false}, {"grip", true}}};

TEST(Channels, are_numbered_sensors_first_and_parted_by_kind) {
    EXPECT_EQ(robot.count(), 4);
    EXPECT_EQ(robot.sensors(), 2);
    EXPECT_EQ(robot.effectors(), 2);
    EXPECT_EQ(robot[2].name, "wheel");
    EXPECT_TRUE(std::ranges::equal(robot.binary(), std::array{1, 3}));
    EXPECT_TRUE(std::ranges::equal(robot.continuous(), std::array{0, 2}));
    EXPECT_EQ(robot.binary_count(), 2);
    EXPECT_EQ(robot.continuous_count(), 2);
}

TEST(Channels, fill_a_word_of_sixteen_bits_and_then_another) {
    auto const words = [](std::size_t sensors) {
        return Channels{std::vector<ChannelInfo>(sensors, {"s", false}), {{"e", false}}}.words();
    };
    EXPECT_EQ(words(1), 1);
    EXPECT_EQ(words(15), 1);
    EXPECT_EQ(words(16), 2);
    EXPECT_EQ(words(79), 5);
    EXPECT_EQ(Channels{}.words(), 0);
}

TEST(Channels, are_equal_by_names_kinds_and_order) {
    EXPECT_EQ(robot, (Channels{{{"range", false}, {"bumper", true}}, {{"wheel", false}, {"grip", true}}}));
    EXPECT_NE(robot, (Channels{{{"bumper", true}, {"range", false}}, {{"wheel", false}, {"grip", true}}}));
    EXPECT_NE(robot, (Channels{{{"range", false}, {"bumper", true}, {"wheel", false}}, {{"grip", true}}}));
    EXPECT_NE(robot, Channels{});
    EXPECT_EQ(Channels{}, (Channels{{}, {}}));
}

TEST(Channels, that_differ_are_told_by_their_numbers_or_the_first_that_does) {
    EXPECT_EQ(why_misfit(robot, robot), "");
    EXPECT_EQ(why_misfit(robot, {{{"range", false}}, {{"wheel", false}}}),
              "made for 2 sensors and 2 effectors, not for 1 and 1");
    EXPECT_EQ(why_misfit(robot, {{{"range", false}, {"whiskers", true}}, {{"wheel", false}, {"grip", true}}}),
              "made for another world: its channel 1 is binary 'bumper', not binary 'whiskers'");
    EXPECT_EQ(why_misfit(robot, {{{"range", false}, {"bumper", true}}, {{"wheel", false}, {"grip", false}}}),
              "made for another world: its channel 3 is binary 'grip', not continuous 'grip'");
}

}   // namespace
}   // namespace lore
