#include <lore/arena/collectball.h>

#include <lore/episode/episode.h>
#include <lore/world/contract.h>

#include "support/complaint.h"

#include <gmock/gmock.h>

#include <array>
#include <vector>

namespace lore {
namespace {

using ::testing::HasSubstr;

Network network_of(std::uint32_t slot) { return compile(founder(Stream{12, Purpose::test, 0, slot})); }

/// Follows run_episode step by step in a life; all values must be equal.
class FollowingLife {
public:
    explicit FollowingLife(World const& world) : life_(world.begin()) {}

    void follow(StepView const& view) {
        Sensors sensors{};
        Position const at = life_->sense(sensors);
        ASSERT_EQ(at, (Position{view.pose.x, view.pose.y})) << view.step;
        ASSERT_EQ(sensors, view.sensors) << view.step;
        StepResult const result = life_->act(view.effectors);
        sum_ += result.reward;
        ASSERT_FALSE(result.over);
        ASSERT_EQ(sum_, view.world.collected) << view.step;
    }
    void compare_outcome(Arena const& arena, WorldState const& last) const {
        std::vector<float> values(2 * arena.task.ball_positions.size());
        life_->outcome(values);
        for (std::size_t ball = 0; ball < arena.task.ball_positions.size(); ++ball)
            EXPECT_EQ((Point{values[2 * ball], values[2 * ball + 1]}), last.released[ball]);
    }

private:
    std::unique_ptr<Life> life_;
    float sum_ = 0;
};

TEST(CollectballWorld, gives_the_episodes_of_run_episode_to_the_bit) {
    for (char const* task : {"source", "target"}) {
        Arena const arena = load_arena("collectball", task);
        CollectballWorld const world{arena};
        for (std::uint32_t slot = 0; slot < 6; ++slot) {
            FollowingLife life{world};
            WorldState const last =
                run_episode(arena, network_of(slot), {}, [&](StepView const& view) { life.follow(view); });
            life.compare_outcome(arena, last);
        }
    }
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
