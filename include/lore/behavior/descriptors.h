#pragma once

#include <lore/arena/arena.h>
#include <lore/core/channels.h>
#include <lore/episode/episode.h>

#include <array>
#include <cstdint>
#include <vector>

namespace lore {

inline constexpr int tiles_per_side = 12;          ///< the arena's longer side is cut in 12 tiles; square tiles
inline constexpr int steps_per_tile_sample = 50;

struct Tile { std::uint8_t x = 0, y = 0; friend bool operator==(Tile const&, Tile const&) = default; };

/// What the four behavioural distances compare (paper, "Dynamic behavioral diversity"); taken from the logged steps:
/// pose and sensors before the move, effectors of the same step.
struct Descriptors {
    std::vector<Point> balls;                       ///< adhoc: where each ball was last released
    std::vector<std::uint16_t> bits;                ///< hamming: Trace::bits, one word a step
    std::vector<Tile> path;                         ///< trajectory: the tile of every 50th step, from step 0
    std::array<double, channel_count> entropies{};  ///< entropy: per channel, in [0, 1]
    friend bool operator==(Descriptors const&, Descriptors const&) = default;
};

/// The plain definition, from a recorded evaluation.
Descriptors describe(Arena const&, Trace const&);

/// Tile of a position: (floor(12 x / width), floor(12 y / width)).
Tile tile_of(Arena const&, float x, float y);

/// Counts per channel over an evaluation; ten bins (floor(9.99 v)) for continuous channels, two for binary ones.
/// Exact integers, so that they may be counted in any order.
struct ChannelHistograms {
    std::array<std::array<std::uint32_t, 10>, continuous_count> continuous{};
    std::array<std::uint32_t, binary_count> ones{};
};
/// Entropies in base (number of bins), from counts that sum to `steps`.
std::array<double, channel_count> entropies(ChannelHistograms const&, int steps);

} // namespace lore
