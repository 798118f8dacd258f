#include <lore/network/network.h>

#include <lore/core/math.h>

#include <algorithm>
#include <bit>
#include <cassert>

namespace lore {

namespace {

/// Per hidden neuron of the genome, its number in the Network, or -1 where no output can be reached from it.
std::vector<int> number_useful_neurons(Genome const& genome) {
    int const first_hidden = genome.first_hidden();
    std::vector<bool> useful(static_cast<std::size_t>(first_hidden + genome.hidden_count()), false);
    std::fill(useful.begin() + genome.interface.first_output(), useful.begin() + first_hidden, true);
    for (bool grows = true; grows;) {
        grows = false;
        for (Edge const& edge : genome.edges)
            if (useful[edge.target] && !useful[edge.source]) grows = useful[edge.source] = true;
    }
    std::vector<int> numbers;
    int next = 0;
    for (int h = 0; h < genome.hidden_count(); ++h)
        numbers.push_back(useful[static_cast<std::size_t>(first_hidden + h)] ? next++ : -1);
    return numbers;
}

}   // namespace

Network compile(Genome const& genome) {
    assert(why_invalid(genome).empty());
    int const inputs = genome.interface.inputs, outputs = genome.interface.outputs;
    int const first_hidden = genome.first_hidden();
    std::vector<int> const numbers = number_useful_neurons(genome);
    Network network;
    network.inputs = inputs;
    network.outputs = outputs;
    network.hidden_count =
        static_cast<int>(std::count_if(numbers.begin(), numbers.end(), [](int n) { return n >= 0; }));

    // Target, source and weight's bits in one number each: numbers sort faster than structs.
    std::vector<std::uint64_t> entries;
    entries.reserve(genome.edges.size());
    for (Edge const& edge : genome.edges) {
        int const target = edge.target < first_hidden ? -1 : numbers[edge.target - first_hidden];
        if (edge.target >= first_hidden && target < 0) continue;
        int const source = edge.source < inputs ? -1 : numbers[edge.source - first_hidden];
        assert(edge.source < inputs || source >= 0);   // what feeds a useful neuron is useful
        auto const to =
            static_cast<std::uint64_t>(edge.target < first_hidden ? edge.target - inputs : outputs + target);
        auto const from = static_cast<std::uint64_t>(edge.source < inputs ? edge.source : inputs + source);
        entries.push_back(to << 40 | from << 32 | std::bit_cast<std::uint32_t>(decode_gene(edge.weight)));
    }
    std::sort(entries.begin(), entries.end());   // no two have the same target and source

    network.first.assign(static_cast<std::size_t>(network.target_count()) + 1, 0);
    network.source.reserve(entries.size());
    network.weight.reserve(entries.size());
    for (std::uint64_t const entry : entries) {
        network.source.push_back(static_cast<std::uint8_t>(entry >> 32));
        network.weight.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(entry)));
        ++network.first[static_cast<std::size_t>(entry >> 40) + 1];
    }
    for (std::size_t target = 1; target < network.first.size(); ++target)
        network.first[target] = static_cast<std::uint16_t>(network.first[target] + network.first[target - 1]);

    for (int output = 0; output < outputs; ++output)
        network.bias.push_back(5.0f * decode_gene(genome.biases[static_cast<std::size_t>(output)]));
    for (std::size_t h = 0; h < numbers.size(); ++h)
        if (numbers[h] >= 0)
            network.bias.push_back(5.0f * decode_gene(genome.biases[static_cast<std::size_t>(outputs) + h]));
    return network;
}

void prune(Genome& genome) {
    int const first_hidden = genome.first_hidden();
    std::size_t const outputs = genome.interface.outputs;
    std::vector<int> const numbers = number_useful_neurons(genome);
    auto const is_useless = [&](NeuronIndex neuron) {
        return neuron >= first_hidden && numbers[neuron - first_hidden] < 0;
    };
    auto const renumber = [&](NeuronIndex& neuron) {
        if (neuron >= first_hidden) neuron = static_cast<NeuronIndex>(first_hidden + numbers[neuron - first_hidden]);
    };
    std::erase_if(genome.edges, [&](Edge const& edge) { return is_useless(edge.source) || is_useless(edge.target); });
    for (Edge& edge : genome.edges) {
        renumber(edge.source);
        renumber(edge.target);
    }
    std::vector<float> biases(genome.biases.begin(), genome.biases.begin() + genome.interface.outputs);
    for (std::size_t h = 0; h < numbers.size(); ++h)
        if (numbers[h] >= 0) biases.push_back(genome.biases[outputs + h]);
    genome.biases = std::move(biases);
}

void tick(Network const& network, std::span<float const> inputs, NetworkState& state, std::span<float> outputs) {
    assert(std::ssize(inputs) == network.inputs && std::ssize(outputs) == network.outputs);
    auto const output_count = static_cast<std::size_t>(network.outputs);
    std::array<float, most_sensors + most_hidden> before;
    std::copy(inputs.begin(), inputs.end(), before.begin());
    std::copy_n(state.hidden.begin(), network.hidden_count, before.begin() + network.inputs);
    for (int target = 0; target < network.target_count(); ++target) {
        auto const t = static_cast<std::size_t>(target);
        float sum = 0.0f;
        for (std::size_t i = network.first[t]; i < network.first[t + 1]; ++i)
            sum += network.weight[i] * before[network.source[i]];
        float const activation = 1.0f / (1.0f + math::exp(network.bias[t] - sum));
        (t < output_count ? outputs[t] : state.hidden[t - output_count]) = activation;
    }
}

}   // namespace lore
