#pragma once

#include <lore/core/random.h>
#include <lore/world/channels.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lore {

/// Neurons are numbered: inputs (the sensors), then outputs (the effectors), then hidden neurons.
using NeuronIndex = std::uint8_t;

/// The neurons that the world prescribes: an input for each sensor, an output for each effector.
struct Interface {
    std::uint8_t inputs = 0, outputs = 0;
    Interface() = default;
    constexpr Interface(int of_inputs, int of_outputs)
        : inputs(static_cast<std::uint8_t>(of_inputs)), outputs(static_cast<std::uint8_t>(of_outputs)) {}
    explicit Interface(Channels const& channels) : Interface(channels.sensors(), channels.effectors()) {}
    constexpr int first_output() const { return inputs; }
    constexpr int first_hidden() const { return inputs + outputs; }
    friend bool operator==(Interface, Interface) = default;
};

/// Ranges of the paper's appendix; their upper ends are enforced as limits, an addition beyond them is not done.
struct NetworkLimits {
    int max_hidden = 30;   ///< Hidden neurons. Paper: number of neurons up to 30.
    int max_edges = 250;   ///< Connections. Paper: up to 250.
};
/// What a Genome can hold whatever the configuration; files and messages are checked against these.
inline constexpr int most_hidden = 64;
inline constexpr int most_edges = 1024;
inline constexpr int most_neurons = most_channels + most_hidden;

/// Weights and biases are stored as genes in [0, 1] and mean gene * 10 - 5.
inline constexpr float gene_span = 10.0f;
inline constexpr float gene_origin = -5.0f;
constexpr float decode_gene(float gene) { return gene * gene_span + gene_origin; }

struct Edge {
    NeuronIndex source = 0;
    NeuronIndex target = 0;
    float weight = 0;   ///< gene in [0, 1]
    friend bool operator==(Edge const&, Edge const&) = default;
};

/// A controller as evolution sees it: a directed graph in a direct encoding (paper, "Robot controller").
///
/// Invariants (why_invalid): sources are inputs or hidden, targets are outputs or hidden, no two edges share both ends,
/// genes in [0, 1]. The order of the edges is part of the genome: mutation walks them in it.
struct Genome {
    Interface interface;
    std::vector<Edge> edges = {};
    std::vector<float> biases = {};   ///< genes; the outputs first, then the hidden neurons

    int hidden_count() const { return static_cast<int>(biases.size()) - interface.outputs; }
    int first_hidden() const { return interface.first_hidden(); }
    friend bool operator==(Genome const&, Genome const&) = default;
};

/// Why the genome breaks an invariant, or "" if it keeps them all.
std::string why_invalid(Genome const&);

/// A random individual of generation 0: every input connected to every output, all genes uniform.
Genome founder(Interface, Stream rng);

}   // namespace lore
