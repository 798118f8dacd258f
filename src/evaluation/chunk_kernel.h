#pragma once

#include <lore/core/isa.h>

#include <cstddef>
#include <cstdint>

/// What is done to every chunk of lanes, compiled once per instruction set (cmake: lore_kernel).
namespace lore {

inline constexpr int tally_bins = 10;
inline constexpr int tally_lanes = 32;

/// Histogram of a continuous channel: counts of the lanes.
struct LaneTally {
    std::uint32_t counts[tally_bins][tally_lanes];
};

/// Adds a chunk of `steps` rows to the histograms of all lanes. values[step][channel][lane], tallies[channel], of
/// `channels` continuous ones; `lanes` is a multiple of the native width, here and below.
using TallyChunk = void(float const* values, int steps, int channels, int lanes, LaneTally* tallies);
/// out[lane][row] = words[row][lane], one place a lane.
using TransposeWords = void(std::uint16_t const* words, int rows, int lanes, std::uint16_t* const* out);
/// ones[bit]: how many of `count` words, `stride` apart, have each of their lowest `bits` bits, 1 to 16.
using CountOnes = void(std::uint16_t const* words, int count, int stride, int bits, std::uint32_t* ones);

struct ChunkKernel {
    TallyChunk* tally;
    TransposeWords* transpose_words;
    CountOnes* count_ones;
};

LORE_KERNEL(ChunkKernel chunk())

}   // namespace lore
