#include <lore/network/genome.h>

#include "support/robot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace lore;
using lore::test::robot;

namespace {

Genome small() { return {robot, {{0, 12, 0.5f}, {3, 15, 0.25f}, {15, 13, 1.0f}}, {0.5f, 0.5f, 0.5f, 0.75f}}; }

}   // namespace

TEST(Founder, joins_every_input_to_every_output_once_with_genes_all_over_the_unit_interval) {
    Genome const genome = founder(robot, Stream{1, Purpose::founder, 0, 7});
    EXPECT_EQ(why_invalid(genome), "");
    EXPECT_EQ(genome.edges.size(), 36u);
    EXPECT_EQ(genome.hidden_count(), 0);
    std::set<float> weights;
    int low = 0;
    for (Edge const& edge : genome.edges) {
        weights.insert(edge.weight);
        low += edge.weight < 0.5f;
    }
    EXPECT_EQ(weights.size(), 36u);
    EXPECT_GT(low, 6);
    EXPECT_LT(low, 30);
}

TEST(Founder, is_a_function_of_its_stream) {
    EXPECT_EQ(founder(robot, Stream{1, Purpose::founder, 0, 7}), founder(robot, Stream{1, Purpose::founder, 0, 7}));
    EXPECT_NE(founder(robot, Stream{1, Purpose::founder, 0, 7}), founder(robot, Stream{1, Purpose::founder, 0, 8}));
}

TEST(Genome, with_every_invariant_kept_is_valid) { EXPECT_EQ(why_invalid(small()), ""); }

TEST(Genome, says_which_invariant_it_breaks) {
    auto reason_after = [](auto change) {
        Genome genome = small();
        change(genome);
        return why_invalid(genome);
    };
    EXPECT_EQ(reason_after([](Genome& g) { g.biases.resize(2); }), "2 biases are fewer than the 3 outputs");
    EXPECT_EQ(reason_after([](Genome& g) { g.biases.resize(100, 0.0f); }), "97 hidden neurons are more than 64");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges.resize(1025); }), "1025 edges are more than 1024");
    EXPECT_EQ(reason_after([](Genome& g) { g.biases[1] = 1.5f; }), "bias 1 is 1.5, not in [0, 1]");
    EXPECT_EQ(reason_after([](Genome& g) { g.biases[1] = NAN; }), "bias 1 is nan, not in [0, 1]");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges[0].weight = -0.5f; }), "weight of edge 0 is -0.5, not in [0, 1]");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges[0].weight = NAN; }), "weight of edge 0 is nan, not in [0, 1]");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges[1].target = 16; }),
              "edge 1 joins 3 to 16, but there are 16 neurons");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges[2].source = 14; }), "edge 2 starts at output neuron 14");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges[2].target = 11; }), "edge 2 ends at input neuron 11");
    EXPECT_EQ(reason_after([](Genome& g) { g.edges.push_back(g.edges[0]); }), "edge 3 repeats 0 to 12");
}
