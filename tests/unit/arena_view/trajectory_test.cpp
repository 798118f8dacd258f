#include <lore/arena_view/trajectory.h>

#include <lore/collectball/arena.h>
#include <lore/figure/svg.h>

#include "support/occurrences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lore {
namespace {

using test::count;

/// A robot that drives to the right for 200 steps, carrying for the second half.
struct Journey {
    std::vector<Pose> poses;
    std::vector<std::uint8_t> carrying;
    TrajectoryPicture picture;
    Journey() {
        for (int step = 0; step < 200; ++step) {
            poses.push_back({230.0f + static_cast<float>(step), 100, 0});
            carrying.push_back(step >= 100);
        }
        picture.title = "a journey";
        picture.lowest = 0;
        picture.highest = 4;
        picture.value_label = "value (balls)";
        picture.values.assign(10, 4.0);
    }
    std::string drawn(ArenaScene const& scene) const { return draw_trajectory(scene, {poses, carrying}, picture); }
};

constexpr std::string_view pale_line = "stroke=\"#deebf7\" stroke-width=\"2.8\"",
                           blue_line = "stroke=\"#08306b\" stroke-width=\"2.8\"";
constexpr std::string_view red_disc = "fill=\"#e0452f\"";

TEST(DrawArenaTrajectory, colors_windows_from_pale_for_low_to_blue_for_high_values) {
    Journey journey;
    journey.picture.values[0] = 0;
    std::string const svg = journey.drawn(scene_of(load_arena("collectball", "source")));
    EXPECT_EQ(count(svg, pale_line), 1);
    EXPECT_EQ(count(svg, blue_line), 9);
}

TEST(DrawArenaTrajectory, leaves_windows_that_were_not_found_without_color) {
    Journey journey;
    journey.picture.values[3] = std::numeric_limits<double>::quiet_NaN();
    std::string const svg = journey.drawn(scene_of(load_arena("collectball", "source")));
    EXPECT_EQ(count(svg, blue_line), 9);
    EXPECT_EQ(count(svg, "nan"), 0);
}

TEST(DrawArenaTrajectory, shows_the_robot_every_50_steps_red_with_a_ball) {
    Journey journey;
    ArenaScene const scene = scene_of(load_arena("collectball", "source"));
    std::string const svg = journey.drawn(scene);
    EXPECT_EQ(count(svg, red_disc), 2 + 1) << "at steps 100 and 150, and in the legend";
}

TEST(DrawArenaTrajectory, shows_a_robot_that_stands_once) {
    Journey journey;
    std::fill(journey.carrying.begin(), journey.carrying.end(), std::uint8_t{1});
    ArenaScene const scene = scene_of(load_arena("collectball", "source"));
    EXPECT_EQ(count(journey.drawn(scene), red_disc), 4 + 1);
    std::fill(journey.poses.begin(), journey.poses.end(), Pose{230, 100, 0});
    EXPECT_EQ(count(journey.drawn(scene), red_disc), 1 + 1);
}

TEST(DrawArenaTrajectory, draws_a_straight_window_with_two_points_and_a_bent_one_with_its_corners) {
    Journey journey;
    for (std::size_t step = 15; step < 20; ++step) journey.poses[step].y += 2 * static_cast<float>(step - 14);
    std::string const svg = journey.drawn(scene_of(load_arena("collectball", "source")));
    int const outline_and_color = 2;
    EXPECT_EQ(count(svg, "points=\"365,176 383.2,176 389.7,189 391,176\""), outline_and_color);
    EXPECT_EQ(count(svg, "points=\"391,176 417,176\""), outline_and_color);
}

TEST(DrawArenaTrajectory, has_neither_strip_nor_color_bar_without_values) {
    Journey journey;
    journey.picture.values.clear();
    std::string const svg = journey.drawn(scene_of(load_arena("collectball", "target")));
    EXPECT_EQ(count(svg, "time (steps)"), 0);
    EXPECT_EQ(count(svg, "value (balls)"), 0);
    EXPECT_EQ(count(svg, "x (u)"), 1);
}

TEST(DrawArenaTrajectory, copes_with_equal_values_and_very_short_evaluations) {
    Journey journey;
    journey.picture.lowest = journey.picture.highest = 4;
    ArenaScene const scene = scene_of(load_arena("collectball", "source"));
    EXPECT_FALSE(render_png(journey.drawn(scene)).empty());
    journey.poses.resize(1);
    journey.carrying.resize(1);
    journey.picture.values.clear();
    EXPECT_FALSE(render_png(journey.drawn(scene)).empty());
}

}   // namespace
}   // namespace lore
