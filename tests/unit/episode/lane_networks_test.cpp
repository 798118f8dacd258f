#include <lore/episode/lane_networks.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace lore {
namespace {

TEST(LaneNetworkLayout, lays_side_by_side_what_feeds_each_target_in_a_vectors_lanes) {
    constexpr int width = 8, lanes = width / lane_vectors;
    // Two inputs (sources 0 and 1), an output (target 0), a hidden neuron (source 2, target 1).
    Network one, two;
    one.inputs = two.inputs = 2;
    one.outputs = two.outputs = 1;
    one.hidden_count = 1;
    one.first = {0, 2, 3};
    one.source = {0, 2, 1};
    one.weight = {0.5f, 1.5f, 2.5f};
    one.bias = {3.5f, 4.5f};
    two.first = {0, 1};
    two.source = {1};
    two.weight = {-0.5f};
    two.bias = {-3.5f};
    std::array<Network const*, width> networks{};
    networks[0] = &one;           // in the first vector
    networks[lanes + 1] = &two;   // in the second
    LaneNetworkLayout layout;
    layout.lay(networks, width);
    LaneNetworks const laid = layout.view();

    ASSERT_EQ(laid.group_count, 1);
    EXPECT_EQ(laid.hidden_count, 1);
    NeuronGroup const& group = laid.groups[0];
    ASSERT_EQ(group.count, 2);
    ASSERT_EQ(group.rounds, 2);   // the output of `one` has two sources
    EXPECT_EQ(group.targets[0][0], 0);
    EXPECT_EQ(group.targets[0][1], 1);
    EXPECT_EQ(group.targets[1][0], 0);
    auto const sources = [&](int round, int vector, int k) {
        return (laid.sources[round * lane_vectors + vector] >> 16 * k & 0xffff) / width;
    };
    EXPECT_EQ(sources(0, 0, 0), 0u);
    EXPECT_EQ(sources(1, 0, 0), 2u);
    EXPECT_EQ(sources(0, 0, 1), 1u);
    EXPECT_EQ(sources(0, 1, 0), 1u);

    constexpr int size = 3 * lane_vectors * 2 * lanes;   // two rounds and the biases
    auto const at = [](int round, int vector, int k, int lane) {
        return ((round * lane_vectors + vector) * 2 + k) * lanes + lane;
    };
    std::array<float, size> expected{};
    expected[at(0, 0, 0, 0)] = 0.5f;
    expected[at(1, 0, 0, 0)] = 1.5f;
    expected[at(0, 0, 1, 0)] = 2.5f;
    expected[at(2, 0, 0, 0)] = 3.5f;
    expected[at(2, 0, 1, 0)] = 4.5f;
    expected[at(0, 1, 0, 1)] = -0.5f;
    expected[at(2, 1, 0, 1)] = -3.5f;
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), laid.weights));
}

}   // namespace
}   // namespace lore
