#include <lore/core/error.h>
#include <lore/core/toml.h>
#include <lore/world/contract.h>
#include <lore/world/open.h>

#include "support/c_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

namespace lore {
namespace {

/// The worlds of docs/examples with physics of others, which are built only where their library is installed.
class PhysicsWorld : public ::testing::Test {
protected:
    explicit PhysicsWorld(std::string name) : name_(std::move(name)) {}

    void SetUp() override {
        if (!std::filesystem::exists(test::c_world(name_)))
            GTEST_SKIP() << name_ << " is not built: 'jobs/install-deps worlds' installs its library";
    }

    std::unique_ptr<World> world(std::string const& settings) const {
        return load_world(test::c_world(name_), settings);
    }

    void expect_contract_kept(std::string const& task) const {
        std::string const file = std::string{LORE_SOURCE_DIR} + "/docs/examples/" + name_ + "/" + task + ".toml";
        std::string const settings =
            TomlTable::read_file(file).required_table("world").required_table("settings").lines();
        auto const open = [&] { return world(settings); };
        ContractReport const report = check_contract(*open(), open, {3, 200, 1});
        for (RuleReport const& rule : report.rules) EXPECT_TRUE(rule.kept) << task << ": " << rule.rule << rule.finding;
        EXPECT_TRUE(report.sample.effectors_matter);
    }

private:
    std::string name_;
};

class Pusher : public PhysicsWorld {
protected:
    Pusher() : PhysicsWorld("pusher") {}

    /// The rewards of a robot that drives straight on from where it starts, where two boxes lie in a line before it.
    static std::vector<float> rewards_straight_on(World const& world) {
        auto const life = world.begin();
        std::vector<float> rewards;
        for (int step = 0; step < 150; ++step) rewards.push_back(life->act(std::array{1.0f, 1.0f}).reward);
        return rewards;
    }
};

TEST_F(Pusher, keeps_its_contract_in_both_tasks) {
    for (char const* task : {"source", "target"}) expect_contract_kept(task);
}

TEST_F(Pusher, senses_boxes_and_the_zone_where_it_starts) {
    std::array<float, 14> sensors{};
    EXPECT_EQ(world("boxes = 3\n")->begin()->sense(sensors), (Position{1.5f, 4}));
    EXPECT_NEAR(sensors[2], 3.75f / 4, 1e-5f) << "to the box ahead";
    EXPECT_NEAR(sensors[5], 1, 1e-5f) << "looks to the zone";
    EXPECT_NEAR(sensors[6], 0.5f, 1e-5f);
    EXPECT_NEAR(sensors[7], 1 - std::hypot(2.5f, 1.5f) / 10, 1e-5f) << "the first of two that are equally near";
    EXPECT_EQ((std::vector<float>{sensors.begin() + 8, sensors.end()}), (std::vector<float>{0, 0, 0, 1, 0, 0}))
        << "it is at the left";
}

TEST_F(Pusher, stands_still_between_forward_and_back) {
    auto const still = world("boxes = 1\n");
    auto const life = still->begin();
    std::array<float, 14> sensors{};
    for (int step = 0; step < 20; ++step) EXPECT_EQ(life->act(std::array{0.5f, 0.5f}), StepResult{});
    EXPECT_EQ(life->sense(sensors), (Position{1.5f, 4}));
}

TEST_F(Pusher, rewards_a_box_on_its_way_or_where_it_arrives) {
    auto const sum = [](std::vector<float> const& rewards) {
        double total = 0;
        for (float const reward : rewards) total += reward;
        return total;
    };
    auto const way = rewards_straight_on(*world("boxes = 3\nreward = \"way\"\n"));
    auto const arrival = rewards_straight_on(*world("boxes = 3\nreward = \"boxes\"\n"));
    EXPECT_NEAR(sum(way), 1, 1e-5) << "the box ahead";
    EXPECT_GT(std::ranges::count_if(way, [](float reward) { return reward > 0; }), 20);
    EXPECT_EQ(sum(arrival), 1);
    EXPECT_EQ(std::ranges::count(arrival, 1.0f), 1);
}

TEST_F(Pusher, has_too_weak_wheels_for_two_heavy_boxes) {
    // The first box of the line meets the second on its way. The robot's momentum moves both a little.
    auto const arrived = [&](std::string const& mass) {
        auto const line = world("boxes = 6\nmass = " + mass + "\nreward = \"boxes\"\n");
        return std::ranges::count(rewards_straight_on(*line), 1.0f);
    };
    EXPECT_EQ(arrived("1.0"), 2);
    EXPECT_EQ(arrived("4.0"), 0);
}

TEST_F(Pusher, is_over_when_all_boxes_are_in_the_zone) {
    auto const one_box = world("boxes = 1\n");   // at (4, 2.5)
    auto const life = one_box->begin();
    std::array<float, 14> sensors{};
    StepResult result;
    double sum = 0;
    int steps = 0;
    for (bool behind_it = false; steps < 300 && !result.over; ++steps) {
        Position const at = life->sense(sensors);
        behind_it |= std::hypot(at.x - 2.5f, at.y - 2.5f) < 0.1f;
        Position const goal = behind_it ? Position{12, 2.5f} : Position{2.5f, 2.5f};
        float const heading = std::atan2(1 - 2 * sensors[6], 2 * sensors[5] - 1);   // by the compass
        float const error =
            std::remainder(std::atan2(goal.y - at.y, goal.x - at.x) - heading, 2 * std::numbers::pi_v<float>);
        float const speed = std::abs(error) < 0.2f ? 0.5f : 0, turn = std::clamp(error, -0.5f, 0.5f);
        result = life->act(std::array{0.5f + 0.5f * speed + 0.5f * turn, 0.5f + 0.5f * speed - 0.5f * turn});
        sum += result.reward;
    }
    EXPECT_TRUE(result.over);
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_EQ(life->act(std::array{1.0f, 0.0f}), (StepResult{0, true}));
    std::array<float, 4> outcome{};
    life->outcome(outcome);
    EXPECT_GT(outcome[2], 8);
}

TEST_F(Pusher, refuses_more_boxes_than_it_has) { EXPECT_THROW(world("boxes = 7\n"), UsageError); }

class Runner : public PhysicsWorld {
protected:
    Runner() : PhysicsWorld("runner") {}

    struct Run {
        double way = 0;   ///< [m]
        bool over = false;
    };

    /// Runs without looking: each motor goes back and forth in a period of 7 or 8 steps, by its own phase.
    static Run run(World const& world, double period, std::array<double, 4> const& phases) {
        auto const life = world.begin();
        Run run;
        for (int step = 0; step < 200 && !run.over; ++step) {
            std::array<float, 4> torques{};
            for (std::size_t k = 0; k < 4; ++k)
                torques[k] =
                    static_cast<float>(0.5 + 0.5 * std::sin(2 * std::numbers::pi * (step / period + phases[k])));
            StepResult const result = life->act(torques);
            run.way += result.reward;
            run.over = result.over;
        }
        return run;
    }
};

TEST_F(Runner, keeps_its_contract_in_both_tasks) {
    for (char const* task : {"source", "target"}) expect_contract_kept(task);
}

TEST_F(Runner, stands_on_both_feet_where_no_motor_turns) {
    auto const flat = world("rise = 0.0\n");
    auto const life = flat->begin();
    std::array<float, 15> sensors{};
    for (int step = 0; step < 100; ++step) EXPECT_NEAR(life->act(std::array{0.5f, 0.5f, 0.5f, 0.5f}).reward, 0, 1e-3);
    EXPECT_NEAR(life->sense(sensors).x, 1.5f, 0.01f);
    EXPECT_NEAR(sensors[10], 0.5f, 1e-3f) << "no speed";
    EXPECT_EQ((std::vector<float>{sensors.begin() + 12, sensors.end()}), (std::vector<float>{1, 1, 0}));
    std::array<float, 3> outcome{};
    life->outcome(outcome);
    EXPECT_NEAR(outcome[0], 0.15f, 1e-3f);
    EXPECT_EQ(outcome[1], 1);
}

TEST_F(Runner, gets_farther_on_flat_ground_than_on_steps) {
    std::array const phases{0.0, 0.75, 0.4, 0.3};
    double const flat = run(*world("rise = 0.0\n"), 7, phases).way, steps = run(*world("rise = 0.08\n"), 7, phases).way;
    EXPECT_GT(flat, 4) << "of 10 s; 7 when this was written";
    EXPECT_LT(steps, flat - 1);
}

TEST_F(Runner, is_over_on_its_back) { EXPECT_TRUE(run(*world("rise = 0.0\n"), 8, {0, 0.35, 0.7, 0.1}).over); }

TEST_F(Runner, refuses_steps_that_it_does_not_have) { EXPECT_THROW(world("rise = 1.0\n"), UsageError); }

}   // namespace
}   // namespace lore
