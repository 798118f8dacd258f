#include <lore/collectball/collectball.h>

#include <lore/episode/episode.h>
#include <lore/world/contract.h>

#include "support/complaint.h"

#include <gmock/gmock.h>

#include <array>
#include <vector>

namespace lore {
namespace {

using ::testing::HasSubstr;

/// A controller whose outputs are constants: no edges, only biases (genes).
Network constant_outputs(float left, float right, float collect) {
    return compile({Interface{collectball_channels()}, {}, {left, right, collect}});
}

TEST(CollectballWorld, has_the_sensors_before_the_move_and_the_effectors_of_the_same_step_in_its_episodes) {
    Arena const arena = load_arena("collectball", "source");
    Trace const trace = record_episode(CollectballWorld{arena}, constant_outputs(0.4f, 0.4f, 0.5f), {});   // forwards
    Sensors const sensors = sense(arena, start_robot(arena), start_world(arena));
    ASSERT_EQ(trace.steps(), 4000);
    EXPECT_EQ(trace.positions[0], (Position{arena.start.x, arena.start.y}));
    EXPECT_NE(trace.positions[1], trace.positions[0]);
    EXPECT_EQ(trace.values[0], sensors[0]);
    EXPECT_GT(trace.values[3], 0.5f);
    for (int b = 0; b < binary_count; ++b)
        EXPECT_EQ(trace.channel_bits[0] >> b & 1, sensors[static_cast<std::size_t>(binary_channels[b])]) << b;
}

TEST(CollectballWorld, ends_a_life_after_more_than_the_given_number_of_still_steps) {
    CollectballWorld const world{load_arena("collectball", "source"), 100};
    EXPECT_EQ(record_episode(world, constant_outputs(0.5f, 0.5f, 0.5f), {}).steps(), 101);
    EXPECT_EQ(record_episode(world, constant_outputs(0.4f, 0.6f, 0.5f), {}).steps(), 4000) << "turning is no rest";
}

TEST(CollectballWorld, ends_with_where_each_ball_was_last_released) {
    Arena const arena = load_arena("collectball", "source");
    Trace const trace = record_episode(CollectballWorld{arena}, constant_outputs(0.5f, 0.5f, 0.5f), {10});
    ASSERT_EQ(trace.outcome.size(), 2 * arena.task.ball_positions.size());
    EXPECT_EQ(trace.outcome[2], arena.task.ball_positions[1].x) << "no ball was taken";
    EXPECT_EQ(trace.outcome[3], arena.task.ball_positions[1].y);
}

TEST(CollectballWorld, rewards_each_ball_at_the_step_that_delivers_it) {
    Arena arena = load_arena("collectball", "source");
    // The robot, the first ball and the basket at one place.
    arena.start = {arena.basket_center.x, arena.basket_center.y, 0};
    arena.task.ball_positions[0] = arena.basket_center;
    CollectballWorld const world{arena};
    auto const life = world.begin();
    EXPECT_EQ(life->act(std::array{0.5f, 0.5f, 1.0f}), (StepResult{0, false})) << "takes the ball";
    EXPECT_EQ(life->act(std::array{0.5f, 0.5f, 0.0f}), (StepResult{1, false})) << "lets it go in the basket";
    EXPECT_EQ(life->act(std::array{0.5f, 0.5f, 0.0f}), (StepResult{0, false}));
}

TEST(CollectballWorld, has_the_channels_of_the_paper_and_keeps_the_contract) {
    std::unique_ptr<World> const world = collectball_world.open("target", "");
    EXPECT_EQ(world->facts().name, "collectball");
    EXPECT_EQ(world->facts().task, "target");
    ASSERT_EQ(world->facts().sensors.size(), 12u);
    EXPECT_EQ(world->facts().sensors[3], (ChannelInfo{"ball_right", true}));
    EXPECT_EQ(world->facts().effectors[2], (ChannelInfo{"collect", false}));
    ContractReport const report =
        check_contract(*world, [] { return collectball_world.open("target", ""); }, {8, 150, 3});
    for (RuleReport const& rule : report.rules) EXPECT_TRUE(rule.kept) << rule.rule << ": " << rule.finding;
}

TEST(CollectballWorld, refuses_settings_and_unknown_tasks) {
    EXPECT_EQ(collectball_world.open("", "")->facts().task, "source");
    EXPECT_THAT(test::complaint_of<UsageError>([] { collectball_world.open("sauce", ""); }),
                HasSubstr("Did you mean 'source'?"));
    EXPECT_THAT(test::complaint_of<UsageError>([] { collectball_world.open("source", "balls = 3\n"); }),
                HasSubstr("it has none"));
}

}   // namespace
}   // namespace lore
