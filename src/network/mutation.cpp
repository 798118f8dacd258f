#include <lore/network/mutation.h>

#include <algorithm>
#include <bit>
#include <bitset>
#include <cassert>
#include <cmath>

namespace lore {

namespace {

/// Sources are numbered inputs first, then hidden neurons; targets outputs first, then hidden neurons.
int source_count(Genome const& genome) { return genome.interface.inputs + genome.hidden_count(); }
int target_count(Genome const& genome) { return genome.interface.outputs + genome.hidden_count(); }
NeuronIndex nth_source(Genome const& genome, int n) {
    return static_cast<NeuronIndex>(n < genome.interface.inputs ? n : n + genome.interface.outputs);
}
NeuronIndex nth_target(Genome const& genome, int n) {
    return static_cast<NeuronIndex>(genome.interface.first_output() + n);
}

/// Which pairs of neurons an edge joins already.
class Connections {
public:
    explicit Connections(Genome const& genome) {
        for (Edge const& edge : genome.edges) joined_.set(position(edge.source, edge.target));
    }
    bool has(NeuronIndex source, NeuronIndex target) const { return joined_[position(source, target)]; }

private:
    static std::size_t position(NeuronIndex source, NeuronIndex target) {
        return source * std::size_t{most_neurons} + target;
    }
    std::bitset<std::size_t{most_neurons} * most_neurons> joined_;
};

}   // namespace

float polynomial_mutation(float gene, int eta, double u) {
    assert(std::has_single_bit(static_cast<unsigned>(eta + 1)));
    auto root = [eta](double x) {
        for (int power = eta + 1; power > 1; power /= 2) x = std::sqrt(x);
        return x;
    };
    double const delta = u < 0.5 ? root(2.0 * u) - 1.0 : 1.0 - root(2.0 * (1.0 - u));
    return static_cast<float>(std::clamp(gene + delta, 0.0, 1.0));
}

void mutate_weights(Genome& genome, MutationConfig const& config, Stream& rng) {
    for (Edge& edge : genome.edges)
        if (rng.chance(config.weight_probability))
            edge.weight = polynomial_mutation(edge.weight, config.eta, rng.uniform());
}

void rewire(Genome& genome, MutationConfig const& config, Stream& rng) {
    for (Edge& edge : genome.edges) {
        if (!rng.chance(config.rewire_probability)) continue;
        Connections const connections{genome};
        bool const redraw_source = rng.coin();
        std::vector<NeuronIndex> free;
        if (redraw_source) {
            for (int n = 0; n < source_count(genome); ++n)
                if (!connections.has(nth_source(genome, n), edge.target)) free.push_back(nth_source(genome, n));
        } else {
            for (int n = 0; n < target_count(genome); ++n)
                if (!connections.has(edge.source, nth_target(genome, n))) free.push_back(nth_target(genome, n));
        }
        if (!free.empty())
            (redraw_source ? edge.source : edge.target) = free[rng.below(static_cast<std::uint32_t>(free.size()))];
        return;
    }
}

void mutate_biases(Genome& genome, MutationConfig const& config, Stream& rng) {
    for (float& bias : genome.biases)
        if (rng.chance(config.bias_probability)) bias = polynomial_mutation(bias, config.eta, rng.uniform());
}

bool add_edge(Genome& genome, NetworkLimits const& limits, Stream& rng) {
    int const edges = static_cast<int>(genome.edges.size());
    int const free = source_count(genome) * target_count(genome) - edges;
    if (edges >= std::min(limits.max_edges, most_edges) || free == 0) return false;
    Connections const connections{genome};
    std::uint32_t chosen = rng.below(static_cast<std::uint32_t>(free));
    for (int s = 0; s < source_count(genome); ++s)
        for (int t = 0; t < target_count(genome); ++t) {
            if (connections.has(nth_source(genome, s), nth_target(genome, t)) || chosen-- != 0) continue;
            genome.edges.push_back({nth_source(genome, s), nth_target(genome, t), static_cast<float>(rng.uniform())});
            return true;
        }
    assert(false && "fewer free pairs than counted: duplicate or misplaced edges");
    return false;
}

bool delete_edge(Genome& genome, Stream& rng) {
    if (genome.edges.empty()) return false;
    genome.edges.erase(genome.edges.begin() + rng.below(static_cast<std::uint32_t>(genome.edges.size())));
    return true;
}

bool split_edge(Genome& genome, NetworkLimits const& limits, Stream& rng) {
    int const edges = static_cast<int>(genome.edges.size());
    if (edges == 0 || edges >= std::min(limits.max_edges, most_edges) ||
        genome.hidden_count() >= std::min(limits.max_hidden, most_hidden))
        return false;
    Edge& edge = genome.edges[rng.below(static_cast<std::uint32_t>(edges))];
    auto const neuron = static_cast<NeuronIndex>(genome.first_hidden() + genome.hidden_count());
    Edge const second_half{neuron, edge.target, edge.weight};
    edge.target = neuron;
    genome.edges.push_back(second_half);
    genome.biases.push_back(static_cast<float>(rng.uniform()));
    return true;
}

bool delete_neuron(Genome& genome, Stream& rng) {
    if (genome.hidden_count() == 0) return false;
    auto const hidden = rng.below(static_cast<std::uint32_t>(genome.hidden_count()));
    auto const neuron = static_cast<NeuronIndex>(static_cast<std::uint32_t>(genome.first_hidden()) + hidden);
    std::erase_if(genome.edges, [neuron](Edge const& edge) { return edge.source == neuron || edge.target == neuron; });
    genome.biases.erase(genome.biases.begin() + genome.interface.outputs + hidden);
    for (Edge& edge : genome.edges) {
        if (edge.source > neuron) --edge.source;
        if (edge.target > neuron) --edge.target;
    }
    return true;
}

void mutate(Genome& genome, MutationConfig const& config, NetworkLimits const& limits, Stream& rng) {
    mutate_weights(genome, config, rng);
    rewire(genome, config, rng);
    mutate_biases(genome, config, rng);
    if (rng.chance(config.add_edge_probability)) add_edge(genome, limits, rng);
    if (rng.chance(config.delete_edge_probability)) delete_edge(genome, rng);
    if (rng.chance(config.add_neuron_probability)) split_edge(genome, limits, rng);
    if (rng.chance(config.delete_neuron_probability)) delete_neuron(genome, rng);
}

}   // namespace lore
