#include <lore/maze/maze.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace lore {
namespace {

constexpr float pi = 3.14159265f;

/// A robot in the middle of an empty square of 400 u, at (200, 200), and a goal at (240, 200).
MazePlan square(std::vector<std::array<float, 4>> walls = {}) {
    MazePlan plan{"square", 400, 400, {200, 200}, {240, 200}, std::move(walls)};
    return plan;
}

/// Left, front left, front, front right, right, back; front, right, back, left.
std::array<float, 10> sensed(MazeWorld const& world, float heading = 0) {
    MazeRules const& rules = world.rules();
    auto robot = rules.start();
    robot.heading = heading;
    robot.cosine = std::cos(heading);
    robot.sine = std::sin(heading);
    std::array<float, 10> values{};
    rules.sense(robot, values.data());
    return values;
}

std::array<float, 6> ranges(MazeWorld const& world, float heading = 0) {
    std::array<float, 6> first{};
    std::copy_n(sensed(world, heading).begin(), 6, first.begin());
    return first;
}

void expect_near(std::array<float, 6> const& values, std::array<float, 6> const& expected) {
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(values[i], expected[i], 1e-5f) << i;
}

TEST(MazeRanges, are_1_where_there_is_no_wall) {
    EXPECT_EQ(ranges(MazeWorld{square()}), (std::array{1.f, 1.f, 1.f, 1.f, 1.f, 1.f}));
}

TEST(MazeRanges, are_the_distances_of_walls_by_100_u) {
    float const slanted = 0.3f * std::sqrt(2.0f);
    // 30 u before the robot, from 50 u to its left to 50 u to its right: the diagonals meet it, too.
    expect_near(ranges(MazeWorld{square({{230, 150, 230, 250}})}), {1, slanted, 0.3f, slanted, 1, 1});
    // The same wall from the right end to the left one.
    expect_near(ranges(MazeWorld{square({{230, 250, 230, 150}})}), {1, slanted, 0.3f, slanted, 1, 1});
    expect_near(ranges(MazeWorld{square({{170, 150, 170, 250}})}), {1, 1, 1, 1, 1, 0.3f});
    expect_near(ranges(MazeWorld{square({{150, 170, 205, 170}})}), {0.3f, 1, 1, 1, 1, 1});
    // y grows downwards: what is below a robot that looks along x is at its right.
    expect_near(ranges(MazeWorld{square({{150, 230, 205, 230}})}), {1, 1, 1, 1, 0.3f, 1});
}

TEST(MazeRanges, are_of_the_nearest_of_two_walls) {
    expect_near(ranges(MazeWorld{square({{260, 190, 260, 210}, {230, 190, 230, 210}})}), {1, 1, 0.3f, 1, 1, 1});
    expect_near(ranges(MazeWorld{square({{230, 190, 230, 210}, {260, 190, 260, 210}})}), {1, 1, 0.3f, 1, 1, 1});
}

TEST(MazeRanges, turn_with_the_robot) {
    MazeWorld const world{square({{230, 190, 230, 210}})};
    expect_near(ranges(world, pi / 2), {0.3f, 1, 1, 1, 1, 1});
    expect_near(ranges(world, pi / 4), {1, 0.3f, 1, 1, 1, 1});
    expect_near(ranges(world, -pi / 4), {1, 1, 1, 0.3f, 1, 1});
    expect_near(ranges(world, -pi / 2), {1, 1, 1, 1, 0.3f, 1});
    expect_near(ranges(world, pi), {1, 1, 1, 1, 1, 0.3f});
}

TEST(MazeRanges, end_where_a_wall_ends_and_at_100_u) {
    expect_near(ranges(MazeWorld{square({{230, 201, 230, 210}})}), {1, 1, 1, 1, 1, 1});
    expect_near(ranges(MazeWorld{square({{230, 200, 230, 210}})}), {1, 1, 0.3f, 1, 1, 1});
    expect_near(ranges(MazeWorld{square({{301, 190, 301, 210}})}), {1, 1, 1, 1, 1, 1});
    // A wall without thickness that lies along the ray is not seen.
    expect_near(ranges(MazeWorld{square({{230, 200, 260, 200}})}), {1, 1, 1, 1, 1, 1});
}

/// By the formula of textbooks, in double: how far a ray goes, 100 at most.
double cast(MazePlan const& plan, double x, double y, double angle) {
    double const cx = std::cos(angle), cy = std::sin(angle);
    double nearest = 100;
    for (auto const& [x0, y0, x1, y1] : plan.walls) {
        double const dx = x1 - x0, dy = y1 - y0, rx = x0 - x, ry = y0 - y, across = cx * dy - cy * dx;
        double const along = (rx * dy - ry * dx) / across, share = (rx * cy - ry * cx) / across;
        if (along >= 0 && share >= 0 && share <= 1) nearest = std::min(nearest, along);
    }
    return nearest;
}

TEST(MazeRanges, agree_with_rays_that_are_cast_one_by_one) {
    std::array const angles{-pi / 2, -pi / 4, 0.0f, pi / 4, pi / 2, pi};
    for (char const* task : {"medium", "hard"}) {
        MazePlan const& plan = maze_plan(task);
        MazeWorld const world{plan};
        auto robot = world.rules().start();
        int misses = 0;   // rays that only just meet the end of a wall
        for (int step = 0; step < 2000; ++step) {
            std::array<float, 10> values{};
            world.rules().sense(robot, values.data());
            for (std::size_t r = 0; r < angles.size(); ++r)
                misses += std::abs(values[r] - cast(plan, robot.x, robot.y, robot.heading + angles[r]) / 100) > 1e-4;
            std::array const changes{0.5f + 0.5f * std::sin(0.05f * static_cast<float>(step)),
                                     step % 50 < 30 ? 0.9f : 0.1f};
            world.rules().act(robot, changes.data());
        }
        EXPECT_LE(misses, 3) << task << ": of 12000";
        EXPECT_GT(std::hypot(robot.x - plan.start.x, robot.y - plan.start.y), 20) << "it has seen something";
    }
}

TEST(MazeSlices, say_in_which_quarter_the_goal_is) {
    MazeWorld const world{square()};   // the goal is along x
    auto const slices = [&](float heading) {
        std::array<float, 4> last{};
        std::copy_n(sensed(world, heading).begin() + 6, 4, last.begin());
        return last;
    };
    std::array<float, 4> const front{1, 0, 0, 0}, right{0, 1, 0, 0}, back{0, 0, 1, 0}, left{0, 0, 0, 1};
    EXPECT_EQ(slices(0), front);
    EXPECT_EQ(slices(0.24f * pi), front);
    EXPECT_EQ(slices(0.26f * pi), left) << "the robot looks to its right, down; the goal is at its left";
    EXPECT_EQ(slices(0.74f * pi), left);
    EXPECT_EQ(slices(0.76f * pi), back);
    EXPECT_EQ(slices(-0.24f * pi), front);
    EXPECT_EQ(slices(-0.26f * pi), right);
    EXPECT_EQ(slices(-0.76f * pi), back);
}

/// Lives of the given maze, by effectors `turn` and `thrust`.
struct Driven {
    explicit Driven(MazePlan const& plan, MazeReward reward = MazeReward::way)
        : world(plan, reward), life(world.begin()) {}
    StepResult act(float turn, float thrust) { return life->act(std::array{turn, thrust}); }
    Position at() const {
        std::array<float, 10> unused{};
        return life->sense(unused);
    }
    MazeWorld world;
    std::unique_ptr<Life> life;
};

TEST(MazeRobot, changes_speed_by_at_most_half_a_unit_a_step_up_to_3) {
    MazePlan plan = square();
    plan.goal = {200, 300};
    Driven robot{plan};
    float expected = 200;
    for (float const speed : {0.5f, 1.0f, 1.5f, 2.0f, 2.5f, 3.0f, 3.0f, 3.0f}) {
        robot.act(0.5f, 1);
        EXPECT_EQ(robot.at(), (Position{expected += speed, 200}));
    }
    robot.act(0.5f, 0.5f);
    EXPECT_EQ(robot.at().x, expected + 3) << "0.5 leaves the speed as it is";
}

TEST(MazeRobot, turns_by_half_a_degree_a_step_more_each_step_up_to_3_degrees) {
    MazeRules const rules = MazeWorld{square()}.rules();
    auto robot = rules.start();
    std::array const changes{1.0f, 0.5f};
    float degrees = 0;
    for (float const turn : {0.5f, 1.0f, 1.5f, 2.0f, 2.5f, 3.0f, 3.0f, 3.0f}) {
        rules.act(robot, changes.data());
        EXPECT_NEAR(robot.heading, (degrees += turn) * pi / 180, 1e-5f);
    }
    for (int step = 0; step < 60; ++step) rules.act(robot, changes.data());
    EXPECT_NEAR(robot.heading, (degrees + 180 - 360) * pi / 180, 1e-4f) << "it stays in -pi .. pi";
}

TEST(MazeRobot, is_stopped_by_a_wall_that_is_nearer_than_8_and_keeps_turning) {
    MazePlan plan = square({{213, 150, 213, 250}});   // 13 u ahead
    Driven robot{plan};
    robot.act(0.5f, 1);   // to 200.5
    robot.act(0.5f, 1);   // to 201.5
    robot.act(0.5f, 1);   // to 203
    robot.act(0.5f, 1);   // to 205: exactly 8 away touches nothing
    EXPECT_EQ(robot.at(), (Position{205, 200}));
    robot.act(0.5f, 1);
    EXPECT_EQ(robot.at(), (Position{205, 200}));
    for (int step = 0; step < 100; ++step) robot.act(step < 10 ? 1.0f : 0.5f, 0.5f);
    EXPECT_LT(robot.at().x, 205) << "it has turned round";
}

TEST(MazeRobot, is_stopped_by_the_end_of_a_wall) {
    Driven robot{square({{213, 204, 213, 250}})};   // passed by a point, not by a disc
    for (int step = 0; step < 10; ++step) robot.act(0.5f, 1);
    EXPECT_LT(robot.at().x, 213 - 6.9f) << "8 from (213, 204)";
}

TEST(MazeReward, adds_up_to_the_share_of_the_way_that_is_gained) {
    MazePlan plan = square();
    plan.goal = {300, 200};   // 100 u ahead
    Driven robot{plan};
    double sum = 0;
    for (int step = 0; step < 8; ++step) sum += robot.act(0.5f, 1).reward;
    ASSERT_EQ(robot.at().x, 216.5f);
    EXPECT_NEAR(sum, 1 - 83.5 / 100, 1e-6);
    for (int step = 0; step < 20; ++step) sum += robot.act(0.5f, 0).reward;   // backwards in the end
    EXPECT_NEAR(sum, 1 - (300 - robot.at().x) / 100, 1e-6);
    EXPECT_LT(sum, 0);
}

TEST(MazeReward, is_1_for_the_goal_which_ends_the_life) {
    for (MazeReward reward : {MazeReward::way, MazeReward::goal}) {
        Driven robot{square(), reward};   // 40 u to go
        double sum = 0;
        StepResult result;
        int steps = 0;
        for (; !result.over; ++steps) sum += (result = robot.act(0.5f, 1)).reward;
        // 0.5 + 1 + 1.5 + 2 + 2.5 + 3 = 10.5 after 6 steps, 37.5 after 15: 2.5 to the goal, nearer than 5.
        EXPECT_EQ(steps, 15);
        EXPECT_NEAR(sum, reward == MazeReward::way ? 1 + 37.5 / 40 : 1, 1e-6);
        std::array<float, 2> outcome{};
        robot.life->outcome(outcome);
        EXPECT_EQ(outcome, (std::array{237.5f, 200.0f}));
    }
}

}   // namespace
}   // namespace lore
