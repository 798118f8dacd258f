#include <lore/episode/episode.h>

#include "support/toy_world.h"

#include <gtest/gtest.h>

#include <array>

namespace lore {
namespace {

using test::random_genome;
using test::ToyWorld;
using test::ToyWorldConfig;

std::vector<std::uint16_t> bits_of(Channels const& channels, std::vector<float> const& values) {
    std::vector<std::uint16_t> words(static_cast<std::size_t>(channels.words()), 0xffff);
    put_channel_bits(channels, values, words);
    return words;
}

TEST(ChannelBits, hold_the_binary_channels_then_the_thresholded_ones) {
    // Sensors: continuous, binary, binary; effectors: continuous.
    Channels const channels{{{"range", false}, {"left", true}, {"right", true}}, {{"wheel", false}}};
    using Words = std::vector<std::uint16_t>;
    EXPECT_EQ(bits_of(channels, {0, 0, 0, 0}), Words{0});
    EXPECT_EQ(bits_of(channels, {0, 1, 0, 0}), Words{1u << 0});
    EXPECT_EQ(bits_of(channels, {0, 0, 1, 0}), Words{1u << 1});
    EXPECT_EQ(bits_of(channels, {0.5f, 0, 0, 0}), Words{0}) << "exactly half is not above it";
    EXPECT_EQ(bits_of(channels, {0.51f, 0, 0, 0}), Words{1u << 2});
    EXPECT_EQ(bits_of(channels, {0, 0, 0, 0.51f}), Words{1u << 3});
}

TEST(ChannelBits, go_on_in_a_further_word_after_sixteen_channels) {
    std::vector<ChannelInfo> sensors;
    for (int i = 0; i < 17; ++i) sensors.push_back({"s" + std::to_string(i), i == 16});
    Channels const channels{sensors, {{"e", false}}};
    ASSERT_EQ(channels.words(), 2);
    std::vector<float> values(18, 0.0f);
    values[16] = 1;   // the one that is binary is bit 0
    values[0] = 1;    // the first of the others is bit 1
    values[17] = 1;   // the last of the others is bit 17
    EXPECT_EQ(bits_of(channels, values), (std::vector<std::uint16_t>{3, 2}));
}

TEST(BinaryEffectors, are_on_above_one_half) {
    Channels const channels{{{"s", false}}, {{"grip", true}, {"wheel", false}}};
    std::array<float, 2> effectors{0.5f, 0.5f};
    round_binary_effectors(channels, effectors);
    EXPECT_EQ(effectors, (std::array{0.0f, 0.5f}));
    effectors = {0.51f, 0.3f};
    round_binary_effectors(channels, effectors);
    EXPECT_EQ(effectors, (std::array{1.0f, 0.3f}));
}

TEST(Episode, records_what_a_life_senses_before_the_action_of_the_same_step) {
    ToyWorld const world{{{false, true, false}, {false, true}, 3}};
    Genome const genome = random_genome(world, 5, 7);
    Trace const trace = record_episode(world, compile(genome), {50});
    ASSERT_EQ(trace.steps(), 50);
    ASSERT_EQ(trace.values.size(), 3u * 50u) << "two sensors and an effector are continuous";

    auto const life = world.begin();
    NetworkState state;
    Network const network = compile(genome);
    double sum = 0;
    std::vector<Reward> rewards;
    for (int step = 0; step < 50; ++step) {
        auto const s = static_cast<std::size_t>(step);
        std::array<float, 3> sensors{};
        std::array<float, 2> effectors{};
        EXPECT_EQ(life->sense(sensors), trace.positions[s]);
        tick(network, sensors, state, effectors);
        effectors[1] = effectors[1] > 0.5f ? 1.0f : 0.0f;
        EXPECT_EQ(trace.values[3 * s], sensors[0]);
        EXPECT_EQ(trace.values[3 * s + 1], sensors[2]);
        EXPECT_EQ(trace.values[3 * s + 2], effectors[0]);
        EXPECT_EQ(trace.channel_bits[s] & 3, (sensors[1] > 0.5f) | (effectors[1] > 0.5f) << 1);
        float const reward = life->act(effectors).reward;
        sum += static_cast<double>(reward);
        if (reward != 0) rewards.push_back({step, reward});
    }
    EXPECT_EQ(trace.reward, sum);
    EXPECT_EQ(trace.rewards, rewards);
    std::vector<float> outcome(3);
    life->outcome(outcome);
    EXPECT_EQ(trace.outcome, outcome);
}

TEST(Episode, ends_with_the_step_that_ends_the_life) {
    ToyWorldConfig config;
    config.end_above = 10;
    ToyWorld const world{config};
    Genome genome{Interface{2, 1}};
    genome.biases = {0.5f};   // always 0.5: more than 10 after 21 steps
    Trace const trace = record_episode(world, compile(genome), {4000});
    EXPECT_EQ(trace.steps(), 21);
    EXPECT_EQ(trace.values.size(), 2u * 21u);
}

TEST(Episode, is_a_prefix_when_it_is_shorter) {
    ToyWorld const world;
    Network const network = compile(random_genome(world, 6, 9));
    Trace const part = record_episode(world, network, {30}), whole = record_episode(world, network, {100});
    ASSERT_EQ(part.steps(), 30);
    EXPECT_TRUE(std::equal(part.channel_bits.begin(), part.channel_bits.end(), whole.channel_bits.begin()));
    EXPECT_TRUE(std::equal(part.positions.begin(), part.positions.end(), whole.positions.begin()));
}

}   // namespace
}   // namespace lore
