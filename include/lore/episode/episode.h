#pragma once

#include <lore/network/network.h>
#include <lore/world/channels.h>
#include <lore/world/world.h>

#include <cstdint>
#include <vector>

namespace lore {

struct EpisodeConfig {
    int steps = 4000;   ///< Length of an evaluation, unless the world ends it before [steps]. Paper: 4000.
};

/// A reward other than 0.
struct Reward {
    int step = 0;
    float amount = 0;   ///< [the world's reward_unit]
    friend bool operator==(Reward const&, Reward const&) = default;
};

/// The sensorimotor record of one evaluation, as windows, descriptors and knowledge bases read it.
///
/// Per step: a bit for every channel, and a float for each continuous one. 26 bytes a step for the channels of the
/// paper, 104 kB an evaluation of 4000 steps.
struct Trace {
    Channels channels;
    /// [step][Channels::words()]. Bit i, counted through the words of a step from the lowest of the first: of the
    /// binary channels, in their order; then whether a continuous channel is above 0.5 (a range sensor: nearer than
    /// half its range), in their order, which only the Hamming descriptor reads. Higher bits are 0.
    std::vector<std::uint16_t> channel_bits;
    std::vector<float> values;         ///< [step][Channels::continuous_count()]
    std::vector<Position> positions;   ///< before the action of that step
    std::vector<Reward> rewards;       ///< in order of steps
    double reward = 0;                 ///< the sum of the rewards, in that order
    std::vector<float> outcome;        ///< how it ended: Life::outcome

    int steps() const { return static_cast<int>(positions.size()); }
};

/// Writes the words of one step, Trace::channel_bits, from the values of all channels, sensors first.
void put_channel_bits(Channels const&, std::span<float const> values, std::span<std::uint16_t> words);

/// What a controller's outputs do: an effector that is binary gets 1 for an output above 0.5, else 0; a continuous one
/// the output itself.
void round_binary_effectors(Channels const&, std::span<float> effectors);

/// One controller in one life, one step after the other: sense, tick, act. The definition of an evaluation that every
/// faster path must equal to the bit. Precondition: the network serves the world's channels.
Trace record_episode(World const&, Network const&, EpisodeConfig const&);

}   // namespace lore
