#include <lore/network/genome.h>

#include <fmt/format.h>

#include <bitset>

namespace lore {

namespace {

bool is_gene(float value) { return value >= 0.0f && value <= 1.0f; }   // false for NaN

}   // namespace

std::string why_invalid(Genome const& genome) {
    Interface const interface = genome.interface;
    int const hidden = genome.hidden_count();
    if (hidden < 0)
        return fmt::format("{} biases are fewer than the {} outputs", genome.biases.size(), interface.outputs);
    if (hidden > most_hidden) return fmt::format("{} hidden neurons are more than {}", hidden, most_hidden);
    if (genome.edges.size() > most_edges)
        return fmt::format("{} edges are more than {}", genome.edges.size(), most_edges);
    for (std::size_t i = 0; i < genome.biases.size(); ++i)
        if (!is_gene(genome.biases[i])) return fmt::format("bias {} is {}, not in [0, 1]", i, genome.biases[i]);

    int const first_output = interface.first_output(), first_hidden = interface.first_hidden();
    int const neurons = first_hidden + hidden;
    std::bitset<256 * 256> seen;
    for (std::size_t i = 0; i < genome.edges.size(); ++i) {
        Edge const& edge = genome.edges[i];
        if (edge.source >= neurons || edge.target >= neurons)
            return fmt::format("edge {} joins {} to {}, but there are {} neurons", i, edge.source, edge.target,
                               neurons);
        if (edge.source >= first_output && edge.source < first_hidden)
            return fmt::format("edge {} starts at output neuron {}", i, edge.source);
        if (edge.target < first_output) return fmt::format("edge {} ends at input neuron {}", i, edge.target);
        if (!is_gene(edge.weight)) return fmt::format("weight of edge {} is {}, not in [0, 1]", i, edge.weight);
        std::size_t const pair = edge.source * 256u + edge.target;
        if (seen[pair]) return fmt::format("edge {} repeats {} to {}", i, edge.source, edge.target);
        seen.set(pair);
    }
    return "";
}

Genome founder(Interface interface, Stream rng) {
    Genome genome{interface};
    for (int input = 0; input < interface.inputs; ++input)
        for (int output = interface.first_output(); output < interface.first_hidden(); ++output)
            genome.edges.push_back(
                {static_cast<NeuronIndex>(input), static_cast<NeuronIndex>(output), static_cast<float>(rng.uniform())});
    for (int output = 0; output < interface.outputs; ++output)
        genome.biases.push_back(static_cast<float>(rng.uniform()));
    return genome;
}

}   // namespace lore
