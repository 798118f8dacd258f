#pragma once

#include <cstdint>

/// What is done to every chunk of lanes, compiled once per instruction set (cmake: lore_kernel).
namespace lore {

inline constexpr int tally_channels = 6;   ///< the continuous channels
inline constexpr int tally_bins = 10;

/// counts[channel][bin][lane].
struct LaneTally {
    std::uint32_t counts[tally_channels][tally_bins][32];
};

/// Adds a chunk of `steps` rows to the histograms of all lanes. values[step][6][lane]; `lanes` is a multiple of the
/// native width, here and below.
using TallyChunk = void(float const* values, int steps, int lanes, LaneTally&);
/// out[lane][step] = words[step][lane], one place a lane.
using TransposeWords = void(std::uint16_t const* words, int steps, int lanes, std::uint16_t* const* out);
/// How many of the words have each of the bits 0..8.
using CountOnes = void(std::uint16_t const* words, int count, std::uint32_t (&ones)[9]);

struct ChunkKernel {
    TallyChunk* tally;
    TransposeWords* transpose_words;
    CountOnes* count_ones;
};

namespace isa_baseline {
extern ChunkKernel const chunk_kernel;
}
namespace isa_v3 {
extern ChunkKernel const chunk_kernel;
}
namespace isa_v4 {
extern ChunkKernel const chunk_kernel;
}

}   // namespace lore
