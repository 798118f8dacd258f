#include <lore/network/mutation.h>

#include "support/robot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace lore;
using lore::test::robot;

namespace {

Stream stream(std::uint32_t slot = 0) { return {20, Purpose::test, 1, slot}; }

/// One input, one hidden neuron with a self loop, one output.
Genome chain() { return {robot, {{2, 15, 0.25f}, {15, 15, 0.5f}, {15, 13, 0.75f}}, {0.1f, 0.2f, 0.3f, 0.4f}}; }

std::vector<Edge> sorted(std::vector<Edge> edges) {
    std::sort(edges.begin(), edges.end(), [](Edge const& a, Edge const& b) {
        return std::pair{a.source, a.target} < std::pair{b.source, b.target};
    });
    return edges;
}

}   // namespace

TEST(PolynomialMutation, follows_its_formula) {
    for (double u : {0.01, 0.2, 0.499, 0.5, 0.75, 0.99}) {
        double const delta = u < 0.5 ? std::pow(2 * u, 1.0 / 16) - 1 : 1 - std::pow(2 * (1 - u), 1.0 / 16);
        EXPECT_NEAR(polynomial_mutation(0.5f, 15, u), 0.5 + delta, 1e-7) << u;
    }
    EXPECT_NEAR(polynomial_mutation(0.5f, 3, 0.25), 0.5 + std::pow(0.5, 0.25) - 1, 1e-7);
    EXPECT_EQ(polynomial_mutation(0.5f, 15, 0.5), 0.5f);
}

TEST(PolynomialMutation, stays_in_the_unit_interval) {
    EXPECT_EQ(polynomial_mutation(0.9f, 15, 1 - 1e-15), 1.0f);
    EXPECT_EQ(polynomial_mutation(0.2f, 15, 0.0), 0.0f);
}

TEST(MutateWeights, changes_weights_at_its_rate_and_nothing_else) {
    MutationConfig const config;
    Stream rng = stream();
    int changed = 0;
    Genome const before = founder(robot, stream(1));
    for (int i = 0; i < 2000; ++i) {
        Genome after = before;
        mutate_weights(after, config, rng);
        EXPECT_EQ(after.biases, before.biases);
        for (std::size_t e = 0; e < before.edges.size(); ++e) {
            EXPECT_EQ(after.edges[e].source, before.edges[e].source);
            EXPECT_EQ(after.edges[e].target, before.edges[e].target);
            changed += after.edges[e].weight != before.edges[e].weight;
        }
    }
    EXPECT_NEAR(changed / (2000.0 * 36), 0.1, 0.005);
}

TEST(MutateBiases, changes_biases_at_its_rate_and_nothing_else) {
    MutationConfig const config;
    Stream rng = stream();
    int changed = 0;
    Genome const before = chain();
    for (int i = 0; i < 10000; ++i) {
        Genome after = before;
        mutate_biases(after, config, rng);
        EXPECT_EQ(after.edges, before.edges);
        for (std::size_t b = 0; b < 4; ++b) changed += after.biases[b] != before.biases[b];
    }
    EXPECT_NEAR(changed / 40000.0, 0.1, 0.01);
}

TEST(Rewire, moves_one_end_of_at_most_one_edge_and_keeps_its_weight_and_place) {
    MutationConfig config;
    config.rewire_probability = 0.5;
    Stream rng = stream();
    int sources = 0, targets = 0;
    for (int i = 0; i < 1000; ++i) {
        Genome after = chain();
        rewire(after, config, rng);
        ASSERT_EQ(why_invalid(after), "");
        int moved = 0;
        for (std::size_t e = 0; e < 3; ++e) {
            Edge const was = chain().edges[e], is = after.edges[e];
            EXPECT_EQ(was.weight, is.weight);
            EXPECT_FALSE(was.source != is.source && was.target != is.target);
            moved += !(was == is);
            sources += was.source != is.source;
            targets += was.target != is.target;
        }
        EXPECT_LE(moved, 1);
    }
    // 7 of 8 mutations move an edge, by a fair coin.
    EXPECT_NEAR(sources, 437, 50);
    EXPECT_NEAR(targets, 437, 50);
}

TEST(Rewire, does_nothing_where_no_other_end_is_free) {
    MutationConfig config;
    config.rewire_probability = 1.0;
    Genome const full = founder(robot, stream());   // without hidden neurons every pair is taken
    Stream rng = stream();
    for (int i = 0; i < 20; ++i) {
        Genome after = full;
        rewire(after, config, rng);
        EXPECT_EQ(after, full);
    }
}

TEST(AddEdge, draws_evenly_among_the_free_pairs) {
    // 13 sources x 4 targets - 3 edges = 49 free pairs
    Stream rng = stream();
    std::map<std::pair<int, int>, int> drawn;
    for (int i = 0; i < 49000; ++i) {
        Genome genome = chain();
        ASSERT_TRUE(add_edge(genome, {}, rng));
        ASSERT_EQ(genome.edges.size(), 4u);
        ++drawn[{genome.edges[3].source, genome.edges[3].target}];
    }
    EXPECT_EQ(drawn.size(), 49u);
    for (auto const& [pair, times] : drawn) EXPECT_NEAR(times, 1000, 150);
    for (Edge const& edge : chain().edges) EXPECT_FALSE(drawn.contains({edge.source, edge.target}));
}

TEST(AddEdge, is_refused_at_the_limit_and_where_no_pair_is_free) {
    Stream rng = stream();
    Genome genome = chain();
    EXPECT_FALSE(add_edge(genome, {30, 3}, rng));
    EXPECT_EQ(genome, chain());
    EXPECT_TRUE(add_edge(genome, {30, 4}, rng));
    Genome full = founder(robot, stream());
    EXPECT_FALSE(add_edge(full, {}, rng));
}

TEST(DeleteEdge, removes_one_edge_and_keeps_the_order_of_the_others) {
    Stream rng = stream();
    std::map<std::size_t, int> removed;
    for (int i = 0; i < 3000; ++i) {
        Genome genome = chain();
        ASSERT_TRUE(delete_edge(genome, rng));
        ASSERT_EQ(genome.edges.size(), 2u);
        std::size_t const gone = genome.edges[0] != chain().edges[0] ? 0 : genome.edges[1] != chain().edges[1] ? 1 : 2;
        ++removed[gone];
        EXPECT_EQ(genome.edges[1], chain().edges[gone == 2 ? 1 : 2]);
    }
    for (std::size_t e = 0; e < 3; ++e) EXPECT_NEAR(removed[e], 1000, 150);
}

TEST(DeleteEdge, is_refused_without_edges) {
    Stream rng = stream();
    Genome genome{robot, {}, {0, 0, 0}};
    EXPECT_FALSE(delete_edge(genome, rng));
}

TEST(SplitEdge, puts_a_neuron_between_the_ends_with_the_old_weight_on_both_sides) {
    Genome genome{robot, {{4, 12, 0.3f}}, {0.1f, 0.2f, 0.3f}};
    Stream rng = stream();
    ASSERT_TRUE(split_edge(genome, {}, rng));
    EXPECT_EQ(genome.edges, (std::vector<Edge>{{4, 15, 0.3f}, {15, 12, 0.3f}}));
    ASSERT_EQ(genome.biases.size(), 4u);
    EXPECT_TRUE(genome.biases[3] > 0.0f && genome.biases[3] < 1.0f);
}

TEST(SplitEdge, is_refused_at_either_limit_and_without_edges) {
    Stream rng = stream();
    Genome genome = chain();
    EXPECT_FALSE(split_edge(genome, {1, 250}, rng));
    EXPECT_FALSE(split_edge(genome, {30, 3}, rng));
    EXPECT_EQ(genome, chain());
    EXPECT_TRUE(split_edge(genome, {2, 4}, rng));
    Genome bare{robot, {}, {0, 0, 0}};
    EXPECT_FALSE(split_edge(bare, {}, rng));
}

TEST(DeleteNeuron, takes_its_edges_with_it_and_renumbers_those_above) {
    Genome const before{robot, {{0, 15, 0.1f}, {15, 16, 0.2f}, {16, 12, 0.3f}, {1, 16, 0.4f}}, {0, 0, 0, 0.5f, 0.6f}};
    Genome const without_first{robot, {{15, 12, 0.3f}, {1, 15, 0.4f}}, {0, 0, 0, 0.6f}};
    Genome const without_second{robot, {{0, 15, 0.1f}}, {0, 0, 0, 0.5f}};
    Stream rng = stream();
    int first = 0, second = 0;
    for (int i = 0; i < 200; ++i) {
        Genome after = before;
        ASSERT_TRUE(delete_neuron(after, rng));
        first += after == without_first;
        second += after == without_second;
    }
    EXPECT_EQ(first + second, 200);
    EXPECT_NEAR(first, 100, 40);
}

TEST(DeleteNeuron, is_refused_without_hidden_neurons) {
    Stream rng = stream();
    Genome genome = founder(robot, stream());
    EXPECT_FALSE(delete_neuron(genome, rng));
}

TEST(Mutate, keeps_the_invariants_and_the_limits_over_thousands_of_mutations) {
    MutationConfig const config;
    NetworkLimits const limits{5, 45};
    int most_neurons = 0;
    std::size_t most = 0;
    for (std::uint32_t line = 0; line < 20; ++line) {
        Genome genome = founder(robot, stream(line));
        Stream rng{21, Purpose::test, 0, line};
        for (int i = 0; i < 1000; ++i) {
            mutate(genome, config, limits, rng);
            ASSERT_EQ(why_invalid(genome), "");
            ASSERT_LE(genome.hidden_count(), limits.max_hidden);
            ASSERT_LE(static_cast<int>(genome.edges.size()), limits.max_edges);
            most_neurons = std::max(most_neurons, genome.hidden_count());
            most = std::max(most, genome.edges.size());
        }
    }
    EXPECT_EQ(most_neurons, 5);
    EXPECT_EQ(most, 45u);
}

TEST(Mutate, reaches_large_networks_when_only_additions_happen) {
    MutationConfig config;
    config.add_edge_probability = config.add_neuron_probability = 1.0;
    config.delete_edge_probability = config.delete_neuron_probability = 0.0;
    Genome genome = founder(robot, stream());
    Stream rng = stream(3);
    for (int i = 0; i < 300; ++i) mutate(genome, config, {}, rng);
    EXPECT_EQ(why_invalid(genome), "");
    EXPECT_EQ(genome.hidden_count(), 30);
    EXPECT_EQ(genome.edges.size(), 250u);
}

TEST(Mutate, is_a_function_of_its_stream) {
    Genome a = chain(), b = chain(), c = chain();
    Stream one = stream(1), same = stream(1), other = stream(2);
    for (int i = 0; i < 50; ++i) {
        mutate(a, {}, {}, one);
        mutate(b, {}, {}, same);
        mutate(c, {}, {}, other);
    }
    EXPECT_EQ(a, b);
    EXPECT_NE(sorted(a.edges), sorted(c.edges));
}
