#include "support/c_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace lore {
namespace {

std::unique_ptr<World> example_world(std::string const& name, std::string const& settings) {
    return load_world(test::c_world(name), settings);
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
