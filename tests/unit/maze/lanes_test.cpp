#include <lore/maze/maze.h>

#include <lore/core/isa.h>

#include "support/trace_client.h"

namespace lore {
namespace {

using test::expect_equal_to_plain_episodes;

/// Every instruction set that this machine has.
class MazeInLanes : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (GetParam() > detected_isa()) GTEST_SKIP() << "this processor has no " << name(GetParam());
        use_isa(GetParam());
    }
    void TearDown() override { use_isa(detected_isa()); }
};
INSTANTIATE_TEST_SUITE_P(OnEveryInstructionSet, MazeInLanes, ::testing::Values(Isa::baseline, Isa::v3, Isa::v4),
                         [](auto const& info) { return std::string{name(info.param)}; });

TEST_P(MazeInLanes, gives_the_episodes_of_one_robot_alone) {
    for (char const* task : {"medium", "hard"})
        for (MazeReward reward : {MazeReward::way, MazeReward::goal}) {
            MazeWorld const world{maze_plan(task), reward};
            expect_equal_to_plain_episodes(world, 70, {400}, 40, run_in_lanes);
            expect_equal_to_plain_episodes(world, 7, {33}, 1, run_in_lanes);
            expect_equal_to_plain_episodes(world, 40, {150}, 40, run_in_batches);
        }
}

/// Lives that end at the goal after a few steps, at steps that differ, so that their lanes get the next ones early.
TEST_P(MazeInLanes, gives_lanes_the_next_life_where_one_has_reached_the_goal) {
    MazePlan plan = maze_plan("medium");
    plan.goal = {plan.start.x + 12, plan.start.y};
    MazeWorld const world{plan};
    std::vector<Network> networks;
    int early = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
        networks.push_back(compile(test::random_genome(world, 31, i)));
        early += record_episode(world, networks.back(), {90}).steps() < 90;
    }
    EXPECT_GT(early, 20);
    EXPECT_LT(early, 180);
    for (int const chunk_steps : {1, 7, 40})
        expect_equal_to_plain_episodes(world, 200, {90}, chunk_steps, run_in_lanes);
}

TEST(MazeOnOtherInstructionSets, gives_the_same_bits) {
    MazeWorld const world{maze_plan("hard")};
    std::vector<Network> networks;
    for (std::uint32_t i = 0; i < 20; ++i) networks.push_back(compile(test::random_genome(world, 7, i)));
    std::vector<std::vector<Trace>> all;
    for (int isa = 0; isa <= static_cast<int>(detected_isa()); ++isa) {
        use_isa(static_cast<Isa>(isa));
        test::TraceClient client{world, networks};
        run_in_lanes(world, {400}, 40, client);
        all.push_back(client.traces());
    }
    use_isa(detected_isa());
    for (auto const& traces : all)
        for (std::size_t i = 0; i < networks.size(); ++i) EXPECT_TRUE(test::equal(traces[i], all[0][i]));
}

}   // namespace
}   // namespace lore
