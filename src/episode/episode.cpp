#include <lore/episode/episode.h>

#include <cassert>

namespace lore {

void put_channel_bits(Channels const& channels, std::span<float const> values, std::span<std::uint16_t> words) {
    std::fill(words.begin(), words.end(), std::uint16_t{0});
    std::size_t bit = 0;
    auto const put = [&](int channel) {
        unsigned const on = values[static_cast<std::size_t>(channel)] > 0.5f;
        words[bit / 16] = static_cast<std::uint16_t>(words[bit / 16] | on << bit % 16);
        ++bit;
    };
    for (int const channel : channels.binary()) put(channel);
    for (int const channel : channels.continuous()) put(channel);
}

void round_binary_effectors(Channels const& channels, std::span<float> effectors) {
    for (int e = 0; e < channels.effectors(); ++e) {
        float& value = effectors[static_cast<std::size_t>(e)];
        if (channels.is_binary(channels.sensors() + e)) value = value > 0.5f ? 1.0f : 0.0f;
    }
}

Trace record_episode(World const& world, Network const& network, EpisodeConfig const& config) {
    Trace trace;
    trace.channels = Channels{world.facts()};
    Channels const& channels = trace.channels;
    assert(network.inputs == channels.sensors() && network.outputs == channels.effectors());
    auto const steps = static_cast<std::size_t>(config.steps), words = static_cast<std::size_t>(channels.words());
    trace.channel_bits.reserve(steps * words);
    trace.positions.reserve(steps);
    trace.values.reserve(steps * static_cast<std::size_t>(channels.continuous_count()));

    std::vector<float> values(static_cast<std::size_t>(channels.count()));
    auto const sensors = std::span{values}.first(static_cast<std::size_t>(channels.sensors()));
    auto const effectors = std::span{values}.subspan(sensors.size());
    auto const life = world.begin();
    NetworkState state;
    for (int step = 0; step < config.steps; ++step) {
        trace.positions.push_back(life->sense(sensors));
        tick(network, sensors, state, effectors);
        round_binary_effectors(channels, effectors);
        trace.channel_bits.resize(trace.channel_bits.size() + words);
        put_channel_bits(channels, values, std::span{trace.channel_bits}.last(words));
        for (int const c : channels.continuous()) trace.values.push_back(values[static_cast<std::size_t>(c)]);
        StepResult const result = life->act(effectors);
        if (result.reward != 0) trace.rewards.push_back({step, result.reward});
        trace.reward += static_cast<double>(result.reward);
        if (result.over) break;
    }
    trace.outcome.resize(static_cast<std::size_t>(world.facts().outcome_size));
    life->outcome(trace.outcome);
    return trace;
}

}   // namespace lore
