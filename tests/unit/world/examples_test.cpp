#include "support/c_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lore {
namespace {

std::unique_ptr<World> example_world(std::string const& name, std::string const& settings) {
    return load_world(test::c_world(name), settings);
}

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

TEST(Maze, senses_walls_and_the_goal_where_the_robot_starts) {
    std::array<float, 10> sensors{};
    auto const world = example_world("maze", "maze = \"medium\"\n");
    EXPECT_EQ(world->begin()->sense(sensors), (Position{30, 22}));
    EXPECT_NEAR(sensors[0], 0.17f, 1e-5f) << "17 to the upper wall, at the left of a robot that looks to the right";
    EXPECT_NEAR(sensors[5], 0.25f, 1e-5f) << "25 to the wall behind";
    EXPECT_NEAR(sensors[1], 0.17f * std::sqrt(2.0f), 1e-5f);
    EXPECT_EQ((std::vector<float>{sensors.begin() + 6, sensors.end()}), (std::vector<float>{1, 0, 0, 0}))
        << "the goal is ahead";
}

TEST(Maze, is_over_at_the_goal_with_a_reward_for_it_and_for_the_way) {
    struct Case {
        char const* maze;
        std::vector<Position> way;
        Position goal;
    };
    for (Case const& one :
         {Case{"medium", {{75, 56}, {112, 31}, {139, 68}, {192, 48}, {213, 79}, {259, 77}, {269, 98}}, {270, 100}},
          Case{"hard",
               {{112, 151}, {168, 178}, {168, 149}, {72, 94}, {92, 69}, {152, 29}, {131, 18}, {33, 22}},
               {31, 20}}}) {
        auto const world = example_world("maze", std::string{"maze = \""} + one.maze + "\"\n");
        auto const life = world->begin();
        Pilot pilot{one.way};
        std::array<float, 10> sensors{};
        std::array<float, 2> outcome{};
        StepResult result;
        Position const start = life->sense(sensors);
        double sum = 0;
        int steps = 0;
        for (; steps < 1000 && !result.over; ++steps) {
            result = life->act(pilot.steer(life->sense(sensors)));
            sum += result.reward;
        }
        EXPECT_TRUE(result.over) << one.maze;
        life->outcome(outcome);
        double const last = std::hypot(outcome[0] - one.goal.x, outcome[1] - one.goal.y);
        EXPECT_LT(last, 5);
        EXPECT_NEAR(sum, 2 - last / std::hypot(start.x - one.goal.x, start.y - one.goal.y), 1e-4);
        RecordProperty(one.maze, steps);
    }
}

TEST(Maze, can_reward_the_goal_alone) {
    auto const world = example_world("maze", "maze = \"hard\"\nreward = \"goal\"\n");
    auto const life = world->begin();
    for (int step = 0; step < 20; ++step) EXPECT_EQ(life->act(std::array{0.5f, 1.0f}), StepResult{});
}

TEST(Pendulum, hangs_until_the_motor_turns_it) {
    auto const world = example_world("pendulum", "length = 1.0\n");
    auto const hanging = world->begin(), driven = world->begin();
    std::array<float, 3> sensors{};
    for (int step = 0; step < 50; ++step) {
        EXPECT_NEAR(hanging->act(std::array{0.5f}).reward, -1, 1e-5);
        driven->act(std::array{1.0f});
    }
    Position const at = hanging->sense(sensors);
    EXPECT_NEAR(at.x, 1.1f, 1e-3) << "below the motor in the middle";
    EXPECT_NEAR(at.y, 2.1f, 1e-3);
    driven->sense(sensors);
    EXPECT_GT(sensors[1], 0.2f) << "half a swing later the tip is higher";
}

/// Pushes with the motion, which adds energy, and holds the pole once it is up.
TEST(Pendulum, can_be_swung_up_and_balanced) {
    auto const world = example_world("pendulum", "length = 1.0\n");
    auto const life = world->begin();
    std::array<float, 3> sensors{};
    double last_hundred = 0;
    for (int step = 0; step < 1000; ++step) {
        life->sense(sensors);
        float const right = 2 * sensors[0] - 1, up = 2 * sensors[1] - 1, speed = 20 * (sensors[2] - 0.5f);
        float const energy = 0.5f * speed * speed + 9.8f * (up - 1);   // 0: that of the pole that stands
        float const torque = up > 0.9f ? -30 * right - 8 * speed : (speed >= 0 ? 5.0f : -5.0f) * (energy < 0 ? 1 : -1);
        StepResult const result = life->act(std::array{0.5f + std::clamp(torque, -5.0f, 5.0f) / 10});
        if (step >= 900) last_hundred += result.reward;
    }
    EXPECT_GT(last_hundred, 95) << "of 100";
}

}   // namespace
}   // namespace lore
