#pragma once

#include <lore/core/channels.h>
#include <lore/core/isa.h>

#include <cstdint>

/// What is done to every chunk of lanes, compiled once per instruction set (cmake: lore_kernel).
namespace lore {

inline constexpr int tally_bins = 10;
inline constexpr int tally_lanes = 32;

/// Histograms of the continuous channels: counts[channel][bin][lane].
struct LaneTally {
    std::uint32_t counts[continuous_count][tally_bins][tally_lanes];
};

/// Adds a chunk of `steps` rows to the histograms of all lanes. values[step][continuous_count][lane]; `lanes` is a
/// multiple of the native width, here and below.
using TallyChunk = void(float const* values, int steps, int lanes, LaneTally&);
/// out[lane][step] = words[step][lane], one place a lane.
using TransposeWords = void(std::uint16_t const* words, int steps, int lanes, std::uint16_t* const* out);
/// How many of the words have each of the bits of binary channels.
using CountOnes = void(std::uint16_t const* words, int count, std::uint32_t (&ones)[binary_count]);

struct ChunkKernel {
    TallyChunk* tally;
    TransposeWords* transpose_words;
    CountOnes* count_ones;
};

LORE_KERNEL(ChunkKernel chunk())

}   // namespace lore
