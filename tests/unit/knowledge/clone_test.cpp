#include "knowledge/traces.h"
#include "support/complaint.h"

#include <lore/core/error.h>
#include <lore/knowledge/clone.h>
#include <lore/network/network.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace lore;

namespace {

/// A base of windows in which a robot with this controller senses at random.
KnowledgeBase base_of(Genome const& controller, int features, int length, std::vector<double> values) {
    Network const network = compile(controller);
    Stream rng{5, Purpose::test};
    KnowledgeArrays arrays;
    for (int step = 0; step < features * length; ++step) {
        auto const bits = static_cast<std::uint16_t>(rng.bits() & test::window_bits_mask);
        std::array<float, sensor_count> sensors{};
        for (int k = 0; k < 3; ++k) sensors[static_cast<std::size_t>(k)] = static_cast<float>(rng.uniform());
        for (int bit = 0; bit < binary_count; ++bit)
            sensors[static_cast<std::size_t>(binary_channels[static_cast<std::size_t>(bit)])] =
                static_cast<float>(bits >> bit & 1);
        std::array<float, effector_count> effectors{};
        NetworkState state;
        tick(network, sensors, state, effectors);
        arrays.bits.push_back(bits);
        arrays.windows.insert(arrays.windows.end(), sensors.begin(), sensors.begin() + 3);
        arrays.windows.insert(arrays.windows.end(), effectors.begin(), effectors.end());
    }
    arrays.reward_sums = values;
    arrays.counts.assign(values.size(), 1);
    arrays.values = std::move(values);
    return KnowledgeBase{test::config_of(length), {}, std::move(arrays)};
}

Genome mild_controller() {
    Genome controller = founder(Interface{collectball_channels()}, Stream{9, Purpose::test});
    for (Edge& edge : controller.edges) edge.weight = 0.4f + 0.2f * edge.weight;   // -1 .. 1
    for (float& bias : controller.biases) bias = 0.48f + 0.04f * bias;             // -1 .. 1 inside the activation
    return controller;
}

/// Each of one step, with one number in every continuous channel.
KnowledgeBase hand_made(std::vector<double> values) {
    Trace trace;
    for (std::size_t i = 0; i < values.size(); ++i) {
        trace.channel_bits.push_back(static_cast<std::uint16_t>(i == 0 ? 0 : 1u << (i - 1)));
        trace.values.insert(trace.values.end(), {0, 0, 0, i == 0 ? 0.0f : 1.0f, 0.5f, 1.0f});
    }
    std::vector<std::uint32_t> const counts(values.size(), 1);
    return KnowledgeBase{test::config_of(1), {}, {trace.channel_bits, trace.values, values, values, counts}};
}

std::string complaint(KnowledgeBase const& base, CloneConfig const& config) {
    return test::complaint_of<UsageError>([&] { clone(base, config); });
}

}   // namespace

TEST(Clone, recovers_the_controller_whose_windows_the_base_holds) {
    Genome const controller = mild_controller();
    Clones const clones = clone(base_of(controller, 2, 200, {1, 1}), {3, 10, 0, 1});
    ASSERT_EQ(clones.genomes.size(), 3u);
    for (Genome const& found : clones.genomes) {
        ASSERT_EQ(found.edges.size(), controller.edges.size());
        for (std::size_t i = 0; i < found.edges.size(); ++i) {
            EXPECT_EQ(found.edges[i].source, controller.edges[i].source);
            EXPECT_EQ(found.edges[i].target, controller.edges[i].target);
            EXPECT_NEAR(found.edges[i].weight, controller.edges[i].weight, 1e-3);
        }
        for (std::size_t i = 0; i < found.biases.size(); ++i) EXPECT_NEAR(found.biases[i], controller.biases[i], 1e-3);
    }
    for (std::size_t e = 0; e < effector_count; ++e) {
        EXPECT_LT(clones.fit[e].absolute_error, 1e-3);
        EXPECT_GT(clones.constant[e].absolute_error, 0.05);
        EXPECT_LT(clones.fit[e].cross_entropy, clones.constant[e].cross_entropy);
    }
}

TEST(Clone, of_two_windows_turns_where_the_one_does_and_goes_straight_where_the_other_does) {
    // The left wheel stands in the dark and runs when the first binary sensor is on; the right wheel is always at 0.5,
    // the grip always shut. Both windows are drawn, so that the best constant for the left wheel is about 0.5.
    Clones const clones = clone(hand_made({2, 2}), {1, 1000, 0, 1});
    Network const network = compile(clones.genomes[0]);
    std::array<float, sensor_count> sensors{};
    std::array<float, effector_count> effectors{};
    NetworkState state;
    tick(network, sensors, state, effectors);
    EXPECT_NEAR(effectors[0], 0, 0.1);   // a weight of 5 at most tells the two apart: 1 / (1 + exp(2.5)) = 0.076
    EXPECT_NEAR(effectors[1], 0.5, 1e-3);
    EXPECT_NEAR(effectors[2], 1, 1e-3);
    sensors[static_cast<std::size_t>(Channel::ball_right)] = 1;
    tick(network, sensors, state, effectors);
    EXPECT_NEAR(effectors[0], 1, 0.1);
    EXPECT_NEAR(clones.constant[0].cross_entropy, std::log(2.0), 0.01);
    EXPECT_NEAR(clones.constant[0].absolute_error, 0.5, 0.01);
    EXPECT_NEAR(clones.fit[0].absolute_error, 1 / (1 + std::exp(2.5)), 0.02);
    EXPECT_TRUE(clones.all_alike);
}

TEST(Clone, draws_windows_in_proportion_to_their_values_less_the_smallest_if_that_is_negative) {
    auto const share_of_second = [](std::vector<double> values) {   // the mean that the best constant's error tells
        Clones const clones = clone(hand_made(std::move(values)), {20, 1000, 0, 3});
        double const error = clones.constant[0].absolute_error;   // 2 p (1 - p)
        return 0.5 * (1 - std::sqrt(1 - 2 * error));
    };
    EXPECT_NEAR(share_of_second({3, 1}), 0.25, 0.01);
    EXPECT_NEAR(share_of_second({9, 1}), 0.10, 0.01);
    EXPECT_NEAR(share_of_second({-1, 7}), 0.0, 1e-12);
    EXPECT_NEAR(share_of_second({1e308, 1e308 / 9}), 0.10, 0.01);
    EXPECT_NEAR(share_of_second({0, 0}), 0.5, 0.02);
    EXPECT_FALSE(clone(hand_made({3, 1}), {1, 10, 0, 3}).all_alike);
}

TEST(Clone, gives_valid_genomes_that_depend_on_the_seed_and_the_founder_alone) {
    KnowledgeBase const base = base_of(founder(Interface{collectball_channels()}, Stream{8, Purpose::test}), 30, 20,
                                       std::vector<double>(30, 1.0));
    for (int const hidden : {0, 3}) {
        auto const genomes = [&](std::uint64_t seed, int count) {
            return clone(base, {count, 10, hidden, seed}).genomes;
        };
        auto const three = genomes(4, 3), five = genomes(4, 5), others = genomes(5, 3);
        EXPECT_EQ(three, genomes(4, 3));
        EXPECT_TRUE(std::equal(three.begin(), three.end(), five.begin()));
        EXPECT_NE(three, others);
        EXPECT_NE(three[0], three[1]);
        for (Genome const& genome : five) {
            EXPECT_EQ(why_invalid(genome), "");
            EXPECT_EQ(genome.hidden_count(), hidden);
            EXPECT_EQ(genome.edges.size(), static_cast<std::size_t>(36 + 15 * hidden));
        }
    }
}

TEST(Clone, fits_better_with_hidden_neurons_what_depends_on_the_tick_before) {
    // The left wheel repeats what the first binary sensor said a tick ago: nothing that reads sensors alone can tell.
    constexpr int length = 200;
    Stream rng{6, Purpose::test};
    KnowledgeArrays arrays;
    float before = 0;
    for (int step = 0; step < length; ++step) {
        bool const light = rng.coin();
        arrays.bits.push_back(light ? 1 : 0);
        arrays.windows.insert(arrays.windows.end(), {0, 0, 0, before, 0.5f, 0.5f});
        before = light ? 1.0f : 0.0f;
    }
    arrays.values = arrays.reward_sums = {1};
    arrays.counts = {1};
    KnowledgeBase const base{test::config_of(length), {}, std::move(arrays)};
    double const plain = clone(base, {1, 1, 0, 1}).fit[0].absolute_error;
    double const deep = clone(base, {1, 1, 10, 1}).fit[0].absolute_error;
    EXPECT_GT(plain, 0.45);
    EXPECT_LT(deep, 0.2);
}

TEST(Clone, tells_the_error_of_the_network_that_it_returns) {
    KnowledgeBase const base =
        base_of(founder(Interface{collectball_channels()}, Stream{7, Purpose::test}), 1, 50, {1});
    for (int const hidden : {0, 4}) {
        Clones const clones = clone(base, {1, 1, hidden, 2});
        Network const network = compile(clones.genomes[0]);
        NetworkState state;
        std::array<double, effector_count> errors{};
        Window const window = base.window(0);
        for (std::size_t step = 0; step < 50; ++step) {
            std::array<float, sensor_count> sensors{};
            for (std::size_t k = 0; k < 3; ++k) sensors[k] = window.values[step * continuous_count + k];
            for (std::size_t bit = 0; bit < binary_channels.size(); ++bit)
                sensors[static_cast<std::size_t>(binary_channels[bit])] =
                    static_cast<float>(window.bits[step] >> bit & 1);
            std::array<float, effector_count> effectors{};
            tick(network, sensors, state, effectors);
            for (std::size_t e = 0; e < effector_count; ++e)
                errors[e] += std::abs(effectors[e] - window.values[step * continuous_count + 3 + e]) / 50;
        }
        for (std::size_t e = 0; e < effector_count; ++e) EXPECT_NEAR(clones.fit[e].absolute_error, errors[e], 1e-5);
    }
}

TEST(Clone, refuses_what_cannot_be) {
    EXPECT_EQ(complaint(hand_made({}), {}),
              "cannot clone founders (the knowledge base has no features). Build another.");
    EXPECT_NE(complaint(hand_made({1}), {0, 1, 0, 1}).find("0 founders"), std::string::npos);
    EXPECT_NE(complaint(hand_made({1}), {1, 0, 0, 1}).find("0 windows"), std::string::npos);
    EXPECT_NE(complaint(hand_made({1}), {1, most_cloned_steps + 1, 0, 1}).find("at most 1000000 steps"),
              std::string::npos);
    EXPECT_NE(complaint(hand_made({1}), {1, 1, most_hidden + 1, 1}).find("hidden neurons"), std::string::npos);
}
