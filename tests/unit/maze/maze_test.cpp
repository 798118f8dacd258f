#include <lore/maze/maze.h>

#include <lore/world/contract.h>

#include "support/complaint.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lore {
namespace {

using ::testing::HasSubstr;

constexpr float degree = 3.14159265f / 180;

/// Steers a robot of the maze by its position, which no controller knows: through the given points in turn.
class Pilot {
public:
    explicit Pilot(std::vector<Position> way) : way_(std::move(way)) {}

    /// Effectors `turn` and `thrust`, which speed up by at most half a degree and half a unit a step.
    std::array<float, 2> steer(Position const& at) {
        if (next_ + 1 < way_.size() && std::hypot(way_[next_].x - at.x, way_[next_].y - at.y) < 4) ++next_;
        float const away = std::hypot(way_[next_].x - at.x, way_[next_].y - at.y);
        float error = std::atan2(way_[next_].y - at.y, way_[next_].x - at.x) - heading_;
        error = std::remainder(error, 360 * degree);
        float const wished_turn = std::clamp(0.3f * error, -3 * degree, 3 * degree);
        float const wished_speed = std::abs(error) < 10 * degree ? std::min(3.0f, 0.3f * away) : 0;
        float const turn = std::clamp((wished_turn - turn_) / degree, -0.5f, 0.5f);
        float const thrust = std::clamp(wished_speed - speed_, -0.5f, 0.5f);
        turn_ += turn * degree;
        speed_ += thrust;
        heading_ += turn_;
        return {turn + 0.5f, thrust + 0.5f};
    }

private:
    std::vector<Position> way_;
    std::size_t next_ = 0;
    float heading_ = 0, turn_ = 0, speed_ = 0;
};

TEST(Maze, has_walls_and_the_goal_where_the_literature_has_them) {
    std::array<float, 10> sensors{};
    MazeWorld const world{maze_plan("medium")};
    EXPECT_EQ(world.begin()->sense(sensors), (Position{30, 22}));
    EXPECT_NEAR(sensors[0], 0.17f, 1e-5f) << "17 to the upper wall, at the left of a robot that looks to the right";
    EXPECT_NEAR(sensors[5], 0.25f, 1e-5f) << "25 to the wall behind";
    EXPECT_NEAR(sensors[1], 0.17f * std::sqrt(2.0f), 1e-5f);
    EXPECT_EQ((std::vector<float>{sensors.begin() + 6, sensors.end()}), (std::vector<float>{1, 0, 0, 0}))
        << "the goal is ahead";
}

TEST(Maze, can_be_solved) {
    struct Case {
        char const* maze;
        std::vector<Position> way;
    };
    for (Case const& one :
         {Case{"medium", {{75, 56}, {112, 31}, {139, 68}, {192, 48}, {213, 79}, {259, 77}, {269, 98}}},
          Case{"hard", {{112, 151}, {168, 178}, {168, 149}, {72, 94}, {92, 69}, {152, 29}, {131, 18}, {33, 22}}}}) {
        MazePlan const& plan = maze_plan(one.maze);
        MazeWorld const world{plan};
        auto const life = world.begin();
        Pilot pilot{one.way};
        std::array<float, 10> sensors{};
        std::array<float, 2> outcome{};
        StepResult result;
        double sum = 0;
        for (int step = 0; step < 400 && !result.over; ++step) {
            result = life->act(pilot.steer(life->sense(sensors)));
            sum += result.reward;
        }
        EXPECT_TRUE(result.over) << one.maze;
        life->outcome(outcome);
        double const last = std::hypot(outcome[0] - plan.goal.x, outcome[1] - plan.goal.y);
        EXPECT_LT(last, 5);
        EXPECT_NEAR(sum, 2 - last / std::hypot(plan.start.x - plan.goal.x, plan.start.y - plan.goal.y), 1e-4);
    }
}

TEST(Maze, keeps_the_contract_of_a_world) {
    for (char const* settings : {"maze = \"medium\"\n", "maze = \"hard\"\nreward = \"goal\"\n"}) {
        std::unique_ptr<World> const world = maze_world.open("", settings);
        ContractReport const report =
            check_contract(*world, [&] { return maze_world.open("", settings); }, {8, 400, 3});
        for (RuleReport const& rule : report.rules) EXPECT_TRUE(rule.kept) << rule.rule << ": " << rule.finding;
    }
}

TEST(Maze, is_chosen_by_its_settings_or_by_the_task_in_the_name_of_the_world) {
    EXPECT_EQ(maze_world.open("", "")->facts().task, "medium");
    EXPECT_EQ(maze_world.open("", "maze = \"hard\"\n")->facts().task, "hard");
    EXPECT_EQ(maze_world.open("hard", "")->facts().task, "hard");
    EXPECT_EQ(maze_world.open("hard", "maze = \"hard\"\n")->facts().task, "hard");
    WorldFacts const facts = maze_world.open("hard", "")->facts();
    EXPECT_EQ(facts.name, "maze");
    EXPECT_EQ(facts.reward_unit, "way");
    ASSERT_EQ(facts.sensors.size(), 10u);
    EXPECT_EQ(facts.sensors[2], (ChannelInfo{"range_front", false}));
    EXPECT_EQ(facts.sensors[6], (ChannelInfo{"goal_front", true}));
}

TEST(Maze, refuses_what_it_does_not_know_in_one_line) {
    auto const complaint = [](std::string const& task, std::string const& settings) {
        return test::complaint_of<UsageError>([&] { maze_world.open(task, settings); });
    };
    EXPECT_THAT(complaint("soft", ""), HasSubstr("there is no maze 'soft' (those are: medium, hard)"));
    EXPECT_THAT(complaint("", "maze = \"soft\"\n"), HasSubstr("there is no maze 'soft' (those are: medium, hard)"));
    EXPECT_THAT(complaint("medium", "maze = \"hard\"\n"), HasSubstr("maze (the world is maze:medium already)"));
    EXPECT_THAT(complaint("", "maze = 3\n"), HasSubstr("a string in quotes is expected"));
    EXPECT_THAT(complaint("", "reward = \"gaol\"\n"),
                HasSubstr("'gaol' is not a reward of a maze (known are way, goal)"));
    EXPECT_THAT(complaint("", "rewards = \"goal\"\n"), HasSubstr("Did you mean 'reward'?"));
}

}   // namespace
}   // namespace lore
