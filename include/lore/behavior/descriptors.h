#pragma once

#include <lore/behavior/tile.h>
#include <lore/episode/episode.h>

#include <array>
#include <cstdint>
#include <vector>

namespace lore {

inline constexpr int steps_per_tile_sample = 50;   ///< the trajectory descriptor looks at every 50th step [steps]
inline constexpr int entropy_bins = 10;            ///< histogram bins of a continuous channel

/// What the four behavioral distances compare (paper, "Dynamic behavioral diversity"); taken from the logged steps:
/// position and sensors before the action, effectors of the same step.
struct Descriptors {
    std::vector<float> outcome;                ///< adhoc: Trace::outcome
    std::vector<std::uint16_t> channel_bits;   ///< hamming: Trace::channel_bits
    std::vector<Tile> path;                    ///< trajectory: the tile of every 50th step, from step 0
    std::vector<double> entropies;             ///< entropy: per channel, in [0, 1]; as many as there are channels

    int channels() const { return static_cast<int>(entropies.size()); }   ///< bits a step of channel_bits
    int words() const { return (channels() + 15) / 16; }                  ///< words a step
    int steps() const { return channels() == 0 ? 0 : static_cast<int>(channel_bits.size()) / words(); }
    friend bool operator==(Descriptors const&, Descriptors const&) = default;
};

/// Calls `visit` with every field, in the order in which checkpoints hold them: the one list of them, by
/// which descriptors are stored, sent, checked and invented.
template <class AnyDescriptors, class Visit>
void for_each_field(AnyDescriptors& descriptors, Visit const& visit) {
    auto& [outcome, channel_bits, path, entropies] = descriptors;   // does not compile while one is missing
    visit(outcome);
    visit(channel_bits);
    visit(path);
    visit(entropies);
}

/// The plain definition, from a recorded evaluation in the world of these facts.
Descriptors describe(WorldFacts const&, Trace const&);

/// Tile of a position: (floor(12 x / side), floor(12 y / side)), side the longer of the world's sides; 11 for one on
/// the far edge.
Tile tile_of(WorldFacts const&, float x, float y);

/// Bin of a continuous channel's value in [0, 1]: floor(9.99 v), so that 1 falls in the last bin.
constexpr int entropy_bin(float value) { return static_cast<int>(9.99f * value); }

/// Counts per channel over an evaluation: entropy_bins for continuous channels, two for binary ones.
/// Exact integers, so that they may be counted in any order.
struct ChannelHistograms {
    explicit ChannelHistograms(Channels const& channels)
        : continuous(static_cast<std::size_t>(channels.continuous_count())),
          ones(static_cast<std::size_t>(channels.binary_count())) {}
    std::vector<std::array<std::uint32_t, entropy_bins>> continuous;   ///< in the order of Channels::continuous
    std::vector<std::uint32_t> ones;                                   ///< in the order of Channels::binary
};
/// Entropies in base (number of bins), channel order, from counts that sum to `steps`; 0 for an evaluation of no steps.
std::vector<double> entropies(Channels const&, ChannelHistograms const&, int steps);

}   // namespace lore
