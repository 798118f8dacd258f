#include <lore/episode/lane_networks.h>

#include <lore/episode/lanes.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <numeric>

namespace lore {

namespace {

constexpr std::size_t most_targets = most_effectors + most_hidden, most_sources = most_sensors + most_hidden;
static_assert(neuron_group_size * 16 == 64 && most_sources * most_lanes <= 1 << 16);   // LaneNetworks::sources

/// What feeds a target in any lane of a vector.
struct Feeds {
    std::bitset<most_sources> sources;
    std::array<std::uint8_t, most_sources> round;   ///< of each of them: how many come before it
    std::size_t rounds = 0;

    void number_rounds(std::size_t source_count) {
        for (std::size_t source = 0; source < source_count; ++source)
            if (sources[source]) round[source] = static_cast<std::uint8_t>(rounds++);
    }
};

/// The targets of a vector's networks.
struct VectorTargets {
    std::array<Feeds, most_targets> feeds;
    std::array<std::size_t, most_targets> order;   ///< most sources first, so that those of a group have about as many

    void read(Network const& network) {
        for (std::size_t target = 0; target + 1 < network.first.size(); ++target)
            for (std::size_t i = network.first[target]; i < network.first[target + 1]; ++i)
                feeds[target].sources.set(network.source[i]);
    }
    void arrange(std::size_t targets, std::size_t source_count) {
        for (std::size_t target = 0; target < targets; ++target) feeds[target].number_rounds(source_count);
        auto const end = std::next(order.begin(), static_cast<std::ptrdiff_t>(targets));
        std::iota(order.begin(), end, std::size_t{0});
        std::stable_sort(order.begin(), end,
                         [&](std::size_t a, std::size_t b) { return feeds[a].rounds > feeds[b].rounds; });
    }
};

/// Where the weights of a target begin, how far one round is from the next, and where its bias is.
struct Place {
    std::size_t first, step, bias;
};

}   // namespace

void LaneNetworkLayout::lay(std::span<Network const* const> networks, int width) {
    auto const row = static_cast<std::size_t>(width), lanes = row / lane_vectors;
    std::array<VectorTargets, lane_vectors> vectors;
    hidden_count_ = 0;
    int inputs = 0, outputs = 0;
    for (std::size_t lane = 0; lane < networks.size(); ++lane) {
        if (networks[lane] == nullptr) continue;
        vectors[lane / lanes].read(*networks[lane]);
        hidden_count_ = std::max(hidden_count_, networks[lane]->hidden_count);
        inputs = networks[lane]->inputs;
        outputs = networks[lane]->outputs;
    }
    auto const targets = static_cast<std::size_t>(outputs + hidden_count_),
               source_count = static_cast<std::size_t>(inputs + hidden_count_);
    for (VectorTargets& vector : vectors) vector.arrange(targets, source_count);

    groups_.clear();
    sources_.clear();
    std::array<std::array<Place, most_targets>, lane_vectors> places;
    std::size_t size = 0;
    for (std::size_t first = 0; first < targets; first += neuron_group_size) {
        std::size_t const count = std::min<std::size_t>(neuron_group_size, targets - first), block = count * lanes;
        std::size_t rounds = 0;
        for (VectorTargets const& vector : vectors) rounds = std::max(rounds, vector.feeds[vector.order[first]].rounds);
        NeuronGroup group{static_cast<int>(count), static_cast<int>(rounds), {}};
        std::size_t const first_sources = sources_.size();
        sources_.resize(first_sources + rounds * lane_vectors, 0);
        for (std::size_t v = 0; v < lane_vectors; ++v)
            for (std::size_t k = 0; k < count; ++k) {
                std::size_t const target = vectors[v].order[first + k], step = lane_vectors * block,
                                  begin = size + v * block + k * lanes;
                group.targets[v][k] = static_cast<int>(target);
                places[v][target] = {begin, step, begin + rounds * step};
                Feeds const& feeds = vectors[v].feeds[target];
                for (std::uint64_t source = 0; source < source_count; ++source) {
                    if (!feeds.sources[source]) continue;
                    sources_[first_sources + feeds.round[source] * lane_vectors + v] |= source * row << 16 * k;
                }
            }
        size += (rounds + 1) * lane_vectors * block;
        groups_.push_back(group);
    }

    weights_.assign_zeros(size);
    for (std::size_t lane = 0; lane < networks.size(); ++lane) {
        if (networks[lane] == nullptr) continue;
        Network const& network = *networks[lane];
        float* const weights = weights_.data() + lane % lanes;
        for (std::size_t target = 0; target + 1 < network.first.size(); ++target) {
            Place const& place = places[lane / lanes][target];
            auto const& round = vectors[lane / lanes].feeds[target].round;
            weights[place.bias] = network.bias[target];
            for (std::size_t i = network.first[target]; i < network.first[target + 1]; ++i)
                weights[place.first + round[network.source[i]] * place.step] = network.weight[i];
        }
    }
}

LaneNetworks LaneNetworkLayout::view() const {
    return {groups_.data(), static_cast<int>(groups_.size()), hidden_count_, sources_.data(), weights_.data()};
}

}   // namespace lore
