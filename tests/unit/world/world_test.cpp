#include <lore/world/world.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace lore {
namespace {

/// Counts its steps; the sensors are that count and the last effector, and the fourth step is the last.
class CountingLife final : public Life {
public:
    Position sense(std::span<float> sensors) const override {
        sensors[0] = static_cast<float>(steps_) / 4;
        sensors[1] = last_;
        return {static_cast<float>(steps_), 1};
    }
    StepResult act(std::span<float const> effectors) override {
        EXPECT_LT(steps_, 4) << "a life that is over does not act";
        last_ = effectors[1];
        return {effectors[0], ++steps_ == 4};
    }
    void outcome(std::span<float> values) const override { values[0] = static_cast<float>(steps_) + last_; }

private:
    int steps_ = 0;
    float last_ = 0;
};

class CountingWorld final : public World {
public:
    CountingWorld() {
        facts_.sensors = {{"share", false}, {"echo", false}};
        facts_.effectors = {{"first", false}, {"second", false}};
        facts_.outcome_size = 1;
    }
    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override { return std::make_unique<CountingLife>(); }

private:
    WorldFacts facts_;
};

TEST(LivesInTurn, put_each_life_in_its_column) {
    CountingWorld const world;
    auto const lives = world.begin_lives(3);
    ASSERT_EQ(lives->count(), 3);
    std::array<float, 6> sensors{};
    std::array<float, 3> x{}, y{}, rewards{}, outcomes{};
    std::array<unsigned char, 3> over{};
    std::array const effectors{0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};   // first of all lives, then second
    lives->act(effectors, rewards, over);
    lives->sense(sensors, x, y);
    lives->outcome(outcomes);
    EXPECT_EQ(rewards, (std::array{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(sensors, (std::array{0.25f, 0.25f, 0.25f, 0.4f, 0.5f, 0.6f}));
    EXPECT_EQ(x, (std::array{1.0f, 1.0f, 1.0f}));
    EXPECT_EQ(outcomes, (std::array{1.4f, 1.5f, 1.6f}));
}

TEST(LivesInTurn, leave_a_life_that_is_over_as_it_is) {
    CountingWorld const world;
    auto const lives = world.begin_lives(1);
    std::array<float, 1> reward{}, outcome{};
    std::array<unsigned char, 1> over{};
    std::array const effectors{0.5f, 0.25f};
    for (int step = 0; step < 4; ++step) {
        EXPECT_EQ(over[0], 0);
        lives->act(effectors, reward, over);
        EXPECT_EQ(reward[0], 0.5f);
    }
    EXPECT_EQ(over[0], 1);
    lives->act(effectors, reward, over);
    lives->outcome(outcome);
    EXPECT_EQ(over[0], 1);
    EXPECT_EQ(reward[0], 0);
    EXPECT_EQ(outcome[0], 4.25f);
}

}   // namespace
}   // namespace lore
