#include <lore/collectball/world.h>

#include <lore/collectball/geometry.h>
#include <lore/core/random.h>

#include "arena_support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lore {
namespace {

constexpr Effectors keep_collecting{0.5f, 0.5f, 1.0f};
constexpr Effectors let_go{0.5f, 0.5f, 0.0f};

float value(Sensors const& sensors, Channel channel) { return sensors[static_cast<std::size_t>(channel)]; }

TEST(StartWorld, has_all_balls_and_a_shut_door_in_the_source_task) {
    WorldState const world = start_world(load_arena("collectball", "source"));
    EXPECT_EQ(world.balls_mask, 255);
    EXPECT_FALSE(world.door_open);
    EXPECT_TRUE(world.switch_lit);
    EXPECT_EQ(world.released[4], (Point{97.5f, 50.625f}));
}

TEST(StartWorld, has_no_ball_and_no_door_in_the_target_task) {
    WorldState const world = start_world(load_arena("collectball", "target"));
    EXPECT_EQ(world.balls_mask, 0);
    EXPECT_TRUE(world.door_open);
    EXPECT_EQ(world.released[0], (Point{0, 0}));
}

TEST(Act, takes_the_first_ball_nearer_than_the_reach) {
    Arena const arena = load_arena("collectball", "source");
    WorldState world = start_world(arena);
    act(arena, {97.5f, 50.625f + 20.0f, 0}, keep_collecting, world);
    EXPECT_FALSE(world.carrying()) << "at exactly 20 u";
    act(arena, {97.5f, 50.625f + 19.99f, 0}, keep_collecting, world);
    EXPECT_EQ(world.carried, 4);
    EXPECT_EQ(world.balls_mask, 255 & ~16);
}

TEST(Act, takes_one_ball_at_a_time) {
    Arena arena = tests::room();
    arena.task.ball_positions = {{100, 100}, {101, 100}};
    compile_geometry(arena);
    WorldState world = start_world(arena);
    for (int i = 0; i < 5; ++i) act(arena, {100, 100, 0}, keep_collecting, world);
    EXPECT_EQ(world.carried, 0) << "the first in index order";
    EXPECT_EQ(world.balls_mask, 2);
}

TEST(Act, does_one_thing_a_step) {
    Arena arena = tests::room();
    arena.task.ball_positions = {arena.switch_position};
    compile_geometry(arena);
    WorldState world = start_world(arena);
    Pose const there{180, 20, 0};
    act(arena, there, keep_collecting, world);
    EXPECT_TRUE(world.carrying());
    EXPECT_TRUE(world.switch_lit) << "the ball came first";
    act(arena, there, keep_collecting, world);
    EXPECT_TRUE(world.switch_lit) << "a carrying robot does not press";
    act(arena, there, let_go, world);
    EXPECT_TRUE(world.switch_lit) << "releasing was the event of this step";
    act(arena, there, keep_collecting, world);
    EXPECT_FALSE(world.switch_lit);
}

TEST(Act, scores_a_ball_released_within_the_basket_and_loses_it_elsewhere) {
    Arena const arena = load_arena("collectball", "source");
    WorldState world = start_world(arena);
    act(arena, {97.5f, 50.625f, 0}, keep_collecting, world);
    Pose const outside{296.25f, 405.0f - 33.76f, 0}, inside{296.25f, 405.0f - 33.74f, 0};
    WorldState lost = world;
    act(arena, outside, let_go, lost);
    EXPECT_EQ(lost.collected, 0);
    EXPECT_EQ(lost.balls_mask, 255 & ~16) << "gone either way";
    EXPECT_EQ(lost.released[4], (Point{outside.x, outside.y}));
    act(arena, inside, let_go, world);
    EXPECT_EQ(world.collected, 1);
    EXPECT_FALSE(world.carrying());
    EXPECT_EQ(world.released[4], (Point{inside.x, inside.y}));
}

TEST(Act, holds_at_a_collect_output_of_one_half) {
    Arena const arena = load_arena("collectball", "source");
    WorldState world = start_world(arena);
    Effectors const half{0.5f, 0.5f, 0.5f}, below{0.5f, 0.5f, std::nextafter(0.5f, 0.0f)};
    act(arena, {97.5f, 50.625f, 0}, below, world);
    EXPECT_FALSE(world.carrying());
    act(arena, {97.5f, 50.625f, 0}, half, world);
    EXPECT_TRUE(world.carrying());
    act(arena, {97.5f, 50.625f, 0}, below, world);
    EXPECT_FALSE(world.carrying());
}

TEST(Act, opens_the_door_for_good_in_the_source_task) {
    Arena const arena = load_arena("collectball", "source");
    WorldState world = start_world(arena);
    Pose const there{532.5f, 50.0f, 0};
    act(arena, there, let_go, world);
    EXPECT_FALSE(world.door_open) << "only a collecting robot presses";
    act(arena, there, keep_collecting, world);
    EXPECT_TRUE(world.door_open);
    for (int i = 0; i < 500; ++i) act(arena, there, keep_collecting, world);
    EXPECT_TRUE(world.door_open);
    EXPECT_FALSE(world.switch_lit) << "the lamp stays out";
}

TEST(Act, lights_the_lamp_of_the_target_task_101_actions_after_the_press) {
    Arena const arena = load_arena("collectball", "target");
    WorldState world = start_world(arena);
    Pose const there{532.5f, 50.0f, 0}, elsewhere{300, 100, 0};
    act(arena, there, keep_collecting, world);
    EXPECT_EQ(world.balls_mask, 1);
    EXPECT_FALSE(world.switch_lit);
    EXPECT_EQ(world.switch_timer, 100);
    for (int later = 1; later <= 100; ++later) {
        act(arena, there, keep_collecting, world);
        EXPECT_FALSE(world.switch_lit) << later;
        EXPECT_EQ(world.switch_timer, 100 - later);
    }
    WorldState pressed_again = world;
    act(arena, elsewhere, keep_collecting, world);
    EXPECT_TRUE(world.switch_lit);
    act(arena, there, keep_collecting, pressed_again);
    EXPECT_FALSE(pressed_again.switch_lit) << "lit and pressed in the same action";
    EXPECT_EQ(pressed_again.switch_timer, 100);
}

TEST(Act, brings_the_ball_of_the_target_task_again_and_again) {
    Arena const arena = load_arena("collectball", "target");
    WorldState world = start_world(arena);
    for (int round = 1; round <= 3; ++round) {
        world.switch_lit = true;
        act(arena, {532.5f, 50.0f, 0}, keep_collecting, world);
        ASSERT_EQ(world.balls_mask, 1);
        act(arena, {97.5f, 50.625f, 0}, keep_collecting, world);
        ASSERT_EQ(world.carried, 0);
        act(arena, {296.25f, 374.0f, 0}, let_go, world);
        EXPECT_EQ(world.collected, round);
    }
}

TEST(Sense, reads_the_start_of_the_source_task) {
    Arena const arena = load_arena("collectball", "source");
    Sensors const s = sense(arena, start_robot(arena), start_world(arena));
    // At +45 degrees of heading 45 the ray goes straight down to the divider at y = 199.66, at -45 along +x to x =
    // 588.85.
    EXPECT_NEAR(value(s, Channel::range_right), 1 - (199.66 - 101.25) / 320, 1e-5);
    EXPECT_NEAR(value(s, Channel::range_left), 1 - (588.85 - 296.25) / 320, 1e-5);
    EXPECT_NEAR(value(s, Channel::range_ahead), 1 - (199.66 - 101.25) * std::sqrt(2.0) / 320, 1e-5);
    EXPECT_EQ(value(s, Channel::ball_right), 1.0f) << "ball 1 straight below";
    EXPECT_EQ(value(s, Channel::ball_left), 1.0f) << "ball 2 ahead to the left";
    EXPECT_EQ(value(s, Channel::basket_right), 0.0f) << "behind the divider";
    EXPECT_EQ(value(s, Channel::switch_right), 0.0f);
    EXPECT_EQ(value(s, Channel::switch_left), 1.0f);
    EXPECT_EQ(value(s, Channel::carrying), 0.0f);
}

TEST(Sense, does_not_see_taken_balls_or_a_lamp_that_is_out) {
    Arena const arena = load_arena("collectball", "source");
    WorldState world = start_world(arena);
    world.balls_mask = 0;
    world.carried = 1;
    world.switch_lit = false;
    Sensors const s = sense(arena, {{296.25f, 101.25f, 0.785f}, true, false}, world);
    EXPECT_EQ(value(s, Channel::ball_right), 0.0f);
    EXPECT_EQ(value(s, Channel::switch_left), 0.0f);
    EXPECT_EQ(value(s, Channel::carrying), 1.0f);
    EXPECT_EQ(value(s, Channel::bumper_right), 1.0f);
    EXPECT_EQ(value(s, Channel::bumper_left), 0.0f);
}

TEST(Sense, stays_within_zero_and_one_anywhere) {
    Arena const arena = load_arena("collectball", "source");
    Stream rng{6, Purpose::test};
    WorldState world = start_world(arena);
    for (int i = 0; i < 20000; ++i) {
        world.door_open = rng.coin();
        RobotState const robot{{static_cast<float>(rng.uniform(0, 600)), static_cast<float>(rng.uniform(0, 400)),
                                static_cast<float>(rng.uniform(-3.14159, 3.14159))},
                               rng.coin(),
                               rng.coin()};
        for (float const s : sense(arena, robot, world)) ASSERT_TRUE(s >= 0.0f && s <= 1.0f);
    }
}

TEST(Move, stops_at_a_wall_but_keeps_the_new_heading) {
    Arena const arena = tests::room();
    RobotState robot{{167, 100, 0}, false, false};   // the wall begins at 190: contact beyond 170
    move(arena, {1.0f, 1.0f, 1.0f}, start_world(arena), robot);
    EXPECT_EQ(robot.pose, (Pose{167, 100, 0}));
    EXPECT_TRUE(robot.bumper_right);
    EXPECT_TRUE(robot.bumper_left);
    move(arena, {0.9f, 1.0f, 1.0f}, start_world(arena), robot);
    EXPECT_EQ(robot.pose.x, 167.0f);
    EXPECT_FLOAT_EQ(robot.pose.theta, 0.02f);
    move(arena, {0.4f, 0.4f, 1.0f}, start_world(arena), robot);
    EXPECT_LT(robot.pose.x, 167.0f);
    EXPECT_FALSE(robot.bumper_right || robot.bumper_left) << "bumpers belong to the last move";
}

TEST(Move, presses_no_bumper_when_backing_into_a_wall) {
    Arena const arena = tests::room();
    RobotState robot{{33, 100, 0}, false, false};
    move(arena, {0.0f, 0.0f, 1.0f}, start_world(arena), robot);
    EXPECT_EQ(robot.pose.x, 33.0f);
    EXPECT_FALSE(robot.bumper_right || robot.bumper_left);
}

TEST(Move, never_ends_in_a_wall) {
    Arena const arena = load_arena("collectball", "source");
    Stream rng{7, Purpose::test};
    WorldState world = start_world(arena);
    RobotState robot = start_robot(arena);
    float left = 1, right = 1;
    int stops = 0;
    for (int i = 0; i < 50000; ++i) {
        if (i == 25000) world.door_open = true;
        if (i % 40 == 0) {
            left = static_cast<float>(rng.uniform(0.2, 1));
            right = static_cast<float>(rng.uniform(0.2, 1));
        }
        Pose const before = robot.pose;
        move(arena, {left, right, 1.0f}, world, robot);
        ASSERT_FALSE(disc_touches(*arena.geometry, robot.pose.x, robot.pose.y, world.door_open)) << i;
        stops += robot.pose.x == before.x && robot.pose.y == before.y;
    }
    EXPECT_GT(stops, 1000);
}

}   // namespace
}   // namespace lore
