#include <lore/network/network.h>

#include <lore/network/mutation.h>

#include "support/robot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace lore;
using lore::test::robot;

namespace {

/// The model's equation on the genome itself, in double precision and with libm, unreachable neurons included.
struct Reference {
    Genome const& genome;
    std::map<int, double> previous;

    std::array<double, 3> tick(std::array<float, 12> const& inputs) {
        std::map<int, double> next;
        for (int n = 12; n < 15 + genome.hidden_count(); ++n) {
            double sum = 0;
            for (Edge const& edge : genome.edges)
                if (edge.target == n)
                    sum +=
                        (edge.weight * 10.0 - 5.0) * (edge.source < 12 ? inputs[edge.source] : previous[edge.source]);
            double const bias = genome.biases[static_cast<std::size_t>(n - 12)] * 10.0 - 5.0;
            next[n] = 1.0 / (1.0 + std::exp(5.0 * bias - sum));
        }
        previous = next;
        return {next[12], next[13], next[14]};
    }
};

}   // namespace

TEST(Compile, leaves_out_neurons_from_which_no_output_can_be_reached) {
    // 15 feeds only 16 and itself, 16 feeds nothing; 17 feeds an output and is fed by 18, which nobody feeds.
    Genome const genome{
        robot,
        {{0, 15, 0.1f}, {15, 15, 0.2f}, {15, 16, 0.3f}, {18, 17, 0.4f}, {17, 14, 0.5f}, {5, 17, 0.6f}, {1, 14, 1.0f}},
        {0.5f, 0.6f, 0.7f, 0.1f, 0.2f, 0.3f, 0.4f}};
    Network const network = compile(genome);
    EXPECT_EQ(network.hidden_count, 2);
    EXPECT_EQ(network.first, (std::vector<std::uint16_t>{0, 0, 0, 2, 4, 4}));
    EXPECT_EQ(network.source, (std::vector<std::uint8_t>{1, 12, 5, 13}));
    EXPECT_EQ(network.weight, (std::vector<float>{5.0f, 0.0f, decode_gene(0.6f), decode_gene(0.4f)}));
    ASSERT_EQ(network.bias.size(), 5u);
    EXPECT_EQ(network.bias[0], 0.0f);
    EXPECT_EQ(network.bias[3], 5.0f * decode_gene(0.3f));
}

TEST(Tick, gives_a_neuron_without_edges_its_constant) {
    Network const network = compile({robot, {}, {0.5f, 0.6f, 0.0f}});
    NetworkState state;
    std::array<float, 12> inputs{};
    std::array<float, 3> outputs{};
    tick(network, inputs, state, outputs);
    EXPECT_EQ(outputs[0], 0.5f);
    EXPECT_NEAR(outputs[1], 1 / (1 + std::exp(5.0)), 1e-8);
    EXPECT_NEAR(outputs[2], 1 / (1 + std::exp(-25.0)), 1e-7);
}

TEST(Tick, passes_inputs_to_outputs_at_once_and_through_a_hidden_neuron_one_tick_later) {
    Network const network = compile({robot, {{0, 12, 1.0f}, {1, 15, 1.0f}, {15, 13, 1.0f}}, {0.5f, 0.5f, 0.5f, 1.0f}});
    NetworkState state;
    std::array<float, 3> outputs{};
    std::array<float, 12> inputs{};
    inputs[0] = inputs[1] = 1.0f;
    tick(network, inputs, state, outputs);
    EXPECT_NEAR(outputs[0], 1 / (1 + std::exp(-5.0)), 1e-6);
    EXPECT_EQ(outputs[1], 0.5f);   // the hidden neuron's state was 0
    double const hidden = 1 / (1 + std::exp(25.0 - 5.0));
    EXPECT_NEAR(state.hidden[0], hidden, 1e-15);
    tick(network, inputs, state, outputs);
    EXPECT_NEAR(outputs[1], 1 / (1 + std::exp(-5.0 * hidden)), 1e-7);
}

TEST(Tick, follows_the_equation_for_evolved_networks) {
    for (std::uint32_t line = 0; line < 30; ++line) {
        Genome genome = founder(robot, {3, Purpose::test, 0, line});
        Stream rng{3, Purpose::test, 1, line};
        MutationConfig growing;
        growing.add_neuron_probability = 0.3;
        for (std::uint32_t i = 0; i < 10 * line; ++i) mutate(genome, growing, {}, rng);
        Network const network = compile(genome);
        Reference reference{genome, {}};
        NetworkState state;
        for (int step = 0; step < 50; ++step) {
            std::array<float, 12> inputs;
            for (float& input : inputs) input = static_cast<float>(rng.uniform());
            std::array<float, 3> outputs{};
            tick(network, inputs, state, outputs);
            auto const expected = reference.tick(inputs);
            for (std::size_t o = 0; o < 3; ++o) ASSERT_NEAR(outputs[o], expected[o], 2e-5);
        }
    }
}

TEST(Tick, saturates_without_infinity_at_the_largest_sums) {
    Genome genome{robot, {}, {1.0f, 0.0f, 0.5f}};
    for (NeuronIndex input = 0; input < 12; ++input) {
        genome.edges.push_back({input, 12, 0.0f});
        genome.edges.push_back({input, 13, 1.0f});
    }
    std::array<float, 12> inputs;
    inputs.fill(1.0f);
    std::array<float, 3> outputs{};
    NetworkState state;
    tick(compile(genome), inputs, state, outputs);
    EXPECT_GT(outputs[0], 0.0f);
    EXPECT_LT(outputs[0], 1e-30f);
    EXPECT_EQ(outputs[1], 1.0f);
}

TEST(Prune, removes_what_reaches_no_output_and_leaves_the_network_as_it_was) {
    // Hidden 15 reads an input and feeds 16; 16 feeds itself alone. Hidden 17 reads 15's input and feeds output 12.
    Genome genome{robot};
    genome.biases = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
    genome.edges = {{0, 15, 0.1f}, {15, 16, 0.2f}, {16, 16, 0.3f}, {0, 17, 0.4f}, {17, 12, 0.5f}, {17, 15, 0.6f}};
    Genome pruned = genome;
    prune(pruned);
    EXPECT_EQ(pruned.biases, (std::vector<float>{0.1f, 0.2f, 0.3f, 0.6f}));
    EXPECT_EQ(pruned.edges, (std::vector<Edge>{{0, 15, 0.4f}, {15, 12, 0.5f}}));
    EXPECT_EQ(why_invalid(pruned), "");
    Network const before = compile(genome), after = compile(pruned);
    EXPECT_EQ(before.first, after.first);
    EXPECT_EQ(before.source, after.source);
    EXPECT_EQ(before.weight, after.weight);
    EXPECT_EQ(before.bias, after.bias);
    Genome const once = pruned;
    prune(pruned);
    EXPECT_EQ(pruned, once);
}
