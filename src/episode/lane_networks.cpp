#include <lore/episode/lane_networks.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cassert>

namespace lore {

namespace {

constexpr int most_targets = most_effectors + most_hidden;
constexpr int most_sources = most_sensors + most_hidden;

}   // namespace

void LaneNetworkLayout::lay(std::span<Network const* const> networks, int width) {
    hidden_count_ = 0;
    int outputs = 0, sources = 0;
    std::array<std::bitset<most_sources>, most_targets> feeds;
    for (Network const* network : networks) {
        if (network == nullptr) continue;
        hidden_count_ = std::max(hidden_count_, network->hidden_count);
        outputs = network->outputs;
        sources = std::max(sources, network->inputs + network->hidden_count);
        for (int target = 0; target < network->target_count(); ++target)
            for (int i = network->first[static_cast<std::size_t>(target)];
                 i < network->first[static_cast<std::size_t>(target) + 1]; ++i)
                feeds[static_cast<std::size_t>(target)].set(network->source[static_cast<std::size_t>(i)]);
    }

    int const targets = outputs + hidden_count_;
    groups_.clear();
    sources_.clear();
    offsets_.clear();
    std::vector<std::array<int, most_sources>> entry_of;   // [group][source]
    int const vector_width = width / lane_vectors;
    int offset = 0;
    for (int first = 0; first < targets;) {
        int const end = first < outputs ? outputs : targets;   // the outputs by themselves
        int const count = std::min(neuron_group_size, end - first);
        NeuronGroup group{count, first, static_cast<int>(sources_.size()), 0};
        std::bitset<most_sources> any;
        for (int k = 0; k < count; ++k) any |= feeds[static_cast<std::size_t>(first + k)];
        entry_of.emplace_back();
        for (int source = 0; source < sources; ++source) {
            if (!any[static_cast<std::size_t>(source)]) continue;
            entry_of.back()[static_cast<std::size_t>(source)] = offset;
            sources_.push_back(source);
            offsets_.push_back(offset);
            offset += count * vector_width;
        }
        group.last_entry = static_cast<int>(sources_.size());
        groups_.push_back(group);
        first += count;
    }

    block_size_ = offset;
    weights_.assign_zeros(static_cast<std::size_t>(block_size_ * lane_vectors));
    biases_.assign_zeros(static_cast<std::size_t>(targets * width));
    for (int lane = 0; lane < static_cast<int>(networks.size()); ++lane) {
        Network const* network = networks[static_cast<std::size_t>(lane)];
        if (network == nullptr) continue;
        int const column = lane / vector_width * block_size_ + lane % vector_width;
        for (std::size_t g = 0; g < groups_.size(); ++g)
            for (int k = 0; k < groups_[g].count; ++k) {
                auto const target = static_cast<std::size_t>(groups_[g].first_target + k);
                if (static_cast<int>(target) >= network->target_count()) continue;
                biases_[target * static_cast<std::size_t>(width) + static_cast<std::size_t>(lane)] =
                    network->bias[target];
                for (std::size_t i = network->first[target]; i < network->first[target + 1]; ++i) {
                    int const place = column + entry_of[g][network->source[i]] + k * vector_width;
                    weights_[static_cast<std::size_t>(place)] = network->weight[i];
                }
            }
    }
}

LaneNetworks LaneNetworkLayout::view() const {
    return {groups_.data(),  static_cast<int>(groups_.size()),
            sources_.data(), offsets_.data(),
            weights_.data(), block_size_,
            biases_.data(),  hidden_count_};
}

}   // namespace lore
