#pragma once

#include <lore/arena/arena.h>
#include <lore/behavior/tile.h>
#include <lore/core/channels.h>
#include <lore/episode/episode.h>

#include <array>
#include <cstdint>
#include <vector>

namespace lore {

inline constexpr int steps_per_tile_sample = 50;      ///< the trajectory descriptor looks at every 50th step [steps]
inline constexpr int entropy_bins = 10;               ///< histogram bins of a continuous channel
inline constexpr int bits_per_step = channel_count;   ///< one bit a channel in the hamming descriptor

/// What the four behavioral distances compare (paper, "Dynamic behavioral diversity"); taken from the logged steps:
/// pose and sensors before the move, effectors of the same step.
struct Descriptors {
    std::vector<Point> ball_positions;               ///< adhoc: where each ball was last released
    std::vector<std::uint16_t> channel_bits;         ///< hamming: Trace::channel_bits, one word a step
    std::vector<Tile> path;                          ///< trajectory: the tile of every 50th step, from step 0
    std::array<double, channel_count> entropies{};   ///< entropy: per channel, in [0, 1]
    friend bool operator==(Descriptors const&, Descriptors const&) = default;
};

/// Calls `visit` with every field, in the order in which checkpoints hold them: the one list of them, by
/// which descriptors are stored, sent, checked and invented.
template <class AnyDescriptors, class Visit>
void for_each_field(AnyDescriptors& descriptors, Visit const& visit) {
    auto& [ball_positions, channel_bits, path, entropies] = descriptors;   // does not compile while one is missing
    visit(ball_positions);
    visit(channel_bits);
    visit(path);
    visit(entropies);
}

/// The plain definition, from a recorded evaluation.
Descriptors describe(Arena const&, Trace const&);

/// Tile of a position inside the arena: (floor(12 x / side), floor(12 y / side)), side the arena's longer side.
Tile tile_of(Arena const&, float x, float y);

/// Bin of a continuous channel's value in [0, 1]: floor(9.99 v), so that 1 falls in the last bin.
constexpr int entropy_bin(float value) { return static_cast<int>(9.99f * value); }

/// Counts per channel over an evaluation: entropy_bins for continuous channels, two for binary ones.
/// Exact integers, so that they may be counted in any order.
struct ChannelHistograms {
    std::array<std::array<std::uint32_t, entropy_bins>, continuous_count> continuous{};
    std::array<std::uint32_t, binary_count> ones{};
};
/// Entropies in base (number of bins), channel order, from counts that sum to `steps`; 0 for an evaluation of no steps.
std::array<double, channel_count> entropies(ChannelHistograms const&, int steps);

}   // namespace lore
