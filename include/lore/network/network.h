#pragma once

#include <lore/network/genome.h>

#include <array>
#include <span>
#include <vector>

namespace lore {

/// A controller as the simulator sees it: a Genome compiled to flat arrays, immutable.
///
/// Hidden neurons from which no output can be reached are left out; the others keep their order. Values of one tick
/// live in one array: the inputs, then the hidden neurons. A neuron's sum runs over its sources in increasing
/// index, starting from zero: this order is part of the definition, because float addition is not associative.
struct Network {
    int inputs = 0, outputs = 0;   ///< Interface
    int hidden_count = 0;
    std::vector<std::uint16_t>
        first;   ///< per target (outputs, then hidden), first entry in source/weight; size targets + 1
    std::vector<std::uint8_t> source;   ///< inputs, then hidden neurons
    std::vector<float> weight;          ///< decoded, [-5, 5]
    std::vector<float> bias;            ///< per target: decoded bias times 5, as the activation uses it

    int target_count() const { return outputs + hidden_count; }
    int edge_count() const { return static_cast<int>(source.size()); }
};

Network compile(Genome const&);
/// Removes the hidden neurons from which no output can be reached, with their edges: those that compile leaves out, so
/// that the Network stays the same. The others keep their order, as do the edges.
void prune(Genome&);

/// What a tick changes.
struct NetworkState {
    std::array<float, most_hidden> hidden{};   ///< outputs of the hidden neurons at the previous tick; 0 at the start
};

/// One synchronous tick: y = 1 / (1 + exp(5 b - sum w x)); every neuron reads the present inputs and the hidden
/// neurons' outputs of the previous tick, so an input-output edge has no delay and each hidden neuron adds one tick.
/// Precondition: as many inputs and outputs as the network has.
void tick(Network const&, std::span<float const> inputs, NetworkState&, std::span<float> outputs);

}   // namespace lore
