#pragma once

#include <lore/arena/world.h>
#include <lore/network/network.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace lore {

struct EpisodeConfig {
    int steps = 4000;          ///< Length of an evaluation [steps]. Paper: 4000.
    int stop_when_still = 0;   ///< Stop once more than this many steps in all went by without movement (position and
                               ///< heading changed by at most 1e-4); 0: never. The predecessor: 100.
};

/// The sensorimotor record of one evaluation, as windows, descriptors and knowledge bases read it.
///
/// Per step: a word with one bit for every channel, and a float for each continuous one. 26 bytes a step for the
/// paper's channels, 104 kB an evaluation of 4000 steps.
struct Trace {
    /// Bits 0 .. binary_count - 1: the binary channels, in the order of binary_channels. Bits binary_count ..
    /// channel_count - 1: whether a continuous channel is above 0.5 (a range sensor: nearer than half its range), in
    /// the order of continuous_channels; only the Hamming descriptor reads these. Higher bits are 0.
    std::vector<std::uint16_t> channel_bits;
    /// [step][continuous_count], continuous_channels order.
    std::vector<float> values;
    std::vector<Pose> poses;       ///< before the move of that step
    std::vector<int> deliveries;   ///< steps whose action delivered a ball, increasing
    WorldState final_world;

    int steps() const { return static_cast<int>(channel_bits.size()); }
};

/// The word of Trace::channel_bits for one step.
std::uint16_t channel_bits(Sensors const&, Effectors const&);

/// One step as an observer sees it; `world` is after the action, `next` after the move.
struct StepView {
    int step;
    Pose const& pose;
    Sensors const& sensors;
    Effectors const& effectors;
    WorldState const& world;
    RobotState const& next;
};

/// One controller in one world, one step after the other: the definition of an evaluation that every faster path must
/// equal to the bit. Allocates nothing inside the loop.
/// `observe` is called after each step. Returns the world's final state.
WorldState run_episode(Arena const&, Network const&, EpisodeConfig const&,
                       std::function<void(StepView const&)> const& observe);

/// The same, recorded.
Trace record_episode(Arena const&, Network const&, EpisodeConfig const&);

}   // namespace lore
