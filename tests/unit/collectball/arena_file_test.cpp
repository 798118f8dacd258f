#include <lore/collectball/arena.h>

#include <lore/collectball/geometry.h>
#include <lore/core/error.h>

#include "arena_support.h"
#include <support/complaint.h>
#include <support/scratch.h>

#include <gtest/gtest.h>

#include <fstream>

namespace lore {
namespace {

/// The message with which the changed built-in arena is refused.
std::string refusal(std::string const& from, std::string const& to, std::string const& task = "source") {
    return test::complaint_of<UsageError>(
        [&] { parse_arena(tests::replaced(arena_text("collectball"), from, to), "changed.toml", task); });
}

void expect_refused(std::string const& from, std::string const& to, std::string const& part) {
    std::string const message = refusal(from, to);
    EXPECT_NE(message.find(part), std::string::npos) << to << "\n  gives: " << message;
    EXPECT_NE(message.find("changed.toml"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(ArenaFile, of_the_paper_is_built_in) {
    Arena const arena = load_arena("collectball", "source");
    EXPECT_EQ(arena.name, "collectball");
    EXPECT_EQ(arena.walls.size(), 10u);
    EXPECT_EQ(arena.doors.size(), 1u);
    EXPECT_EQ(arena.walls[0], (Rect{0, 9.12f, 0, 400.34f}));
    EXPECT_EQ(arena.task.ball_positions.size(), 8u);
    EXPECT_EQ(arena.start, (Pose{296.25f, 101.25f, 0.785398163f}));
    EXPECT_EQ(arena.robot.field_of_view, RobotConfig{}.field_of_view);
    EXPECT_EQ(arena.robot.radius, RobotConfig{}.radius);
    Arena const target = load_arena("collectball", "target");
    EXPECT_TRUE(target.doors.empty());
    EXPECT_EQ(target.task.switch_pause, 100);
    EXPECT_EQ(target.task.door, DoorRule::absent);
    EXPECT_EQ(target.task.ball_rule, BallRule::one_per_press);
}

TEST(ArenaFile, is_also_read_from_a_path) {
    Scratch const scratch;
    std::ofstream{scratch.file("mine.toml")} << tests::replaced(arena_text("collectball"), "reach = 20", "reach = 25");
    EXPECT_EQ(load_arena(scratch.file("mine.toml"), "target").reach, 25.0f);
}

TEST(ArenaFile, that_is_missing_is_reported_with_the_nearest_built_in_name) {
    try {
        load_arena("colectball", "source");
        FAIL();
    } catch (UsageError const& error) {
        EXPECT_NE(std::string{error.what()}.find("Did you mean 'collectball'?"), std::string::npos) << error.what();
    }
    Scratch const scratch;
    EXPECT_THROW(load_arena(scratch.path(), "source"), UsageError) << "a directory";
}

TEST(ArenaFile, must_know_the_task) {
    EXPECT_NE(refusal("reach = 20", "reach = 20", "sorce").find("Did you mean 'source'?"), std::string::npos);
}

TEST(ArenaFile, may_not_hold_unknown_keys) {
    expect_refused("reach = 20", "raech = 20", "reach");
    expect_refused("sensor_range", "sensor_rnage", "sensor_range");
    expect_refused("name = \"floor\", ", "nmae = \"floor\", ", "Did you mean");
    expect_refused("[task.source] ", "pause = 1\n[task.source] ", "pause");
    expect_refused("switch_pause = 100", "switch_pauze = 100", "switch_pause");
}

TEST(ArenaFile, needs_values_in_their_ranges) {
    expect_refused("size = [600, 400.34]", "size = [600, -1]", "size");
    expect_refused("size = [600, 400.34]", "size = [600]", "2 numbers");
    expect_refused("reach = 20", "reach = nan", "reach");
    expect_refused("x = [0, 600],          y = [394.26, 400.34]", "x = [600, 0], y = [394.26, 400.34]", "first bound");
    expect_refused("x = [0, 600],          y = [394.26, 400.34]", "x = [0, 601], y = [394.26, 400.34]",
                   "outside the arena");
    expect_refused("radius = 33.75", "radius = -1", "radius");
    expect_refused("switch_pause = 100", "switch_pause = -1", "switch_pause");
    expect_refused("positions = [[97.5, 50.625]]", "positions = []", "1 to 16 points");
    expect_refused("positions = [[97.5, 50.625]]", "positions = [[97.5]]", "pairs");
    expect_refused("positions = [[97.5, 50.625]]", "positions = [[97.5, inf]]", "finite");
    expect_refused("door = \"absent\"", "door = \"abscent\"", "Did you mean 'absent'?");
    expect_refused("field_of_view_degrees = 90", "field_of_view_degrees = 190", "field_of_view_degrees");
}

TEST(ArenaFile, must_be_closed) {
    expect_refused("x = [0, 600],          y = [394.26, 400.34]", "x = [0, 588], y = [394.26, 400.34]", "not closed");
    expect_refused("x = [588.85, 600],     y = [0, 400.34]", "x = [588.85, 600], y = [9.13, 400.34]",
                   "not closed");   // by 0.01 u
}

TEST(ArenaFile, must_be_closed_behind_its_door_too) {
    expect_refused("x = [0, 9.12],         y = [0, 400.34]", "x = [0, 9.12], y = [0, 390]", "not closed");
}

TEST(ArenaFile, may_not_bury_anything_in_a_wall) {
    expect_refused("position = [296.25, 101.25]", "position = [296.25, 25]", "would touch a wall");
    expect_refused("switch = [532.5, 40.5]", "switch = [595, 40.5]", "the switch");
    expect_refused("[285, 385]", "[285, 395]", "basket light 1");
    expect_refused("[397.5, 50.625], [397.5, 151.875]", "[397.5, 5], [397.5, 151.875]", "ball 2");
    expect_refused("[97.5, 253.125]", "[204, 300]", "ball 6");   // in the shut door
    expect_refused("[97.5, 253.125]", "[97.5, 500]", "outside the arena");
}

TEST(ArenaFile, is_checked_for_all_its_tasks) {
    expect_refused("positions = [[97.5, 50.625]]", "positions = [[5, 5]]", "task 'target'");
}

TEST(ArenaFile, must_list_the_channels_that_a_controller_serves) {
    expect_refused("\"range_ahead\"", "\"range_front\"", "no 'range_front'");
    expect_refused("\"bumper_left\", \"carrying\"", "\"bumper_left\", \"carying\"", "Did you mean 'carrying'?");
    expect_refused("\"bumper_right\", \"bumper_left\"", "\"bumper_left\", \"bumper_right\"", "in this order");
    expect_refused(", \"carrying\"]", "]", "'carrying' is missing");
    expect_refused("\"carrying\"]", "\"carrying\", \"carrying\"]", "number 13");
    expect_refused("\"left_wheel\", ", "", "number 1");
}

TEST(ArenaFile, may_not_make_the_robot_too_fast_for_its_size) {
    expect_refused("max_speed = 4 ", "max_speed = 11 ", "turn");
    expect_refused("radius = 20\n", "radius = 3\n", "jump");
}

}   // namespace
}   // namespace lore
