#pragma once

#include <lore/episode/lane_tick.h>

#include <cstdint>

namespace lore {

/// Where a kernel that steps lanes reads their networks and writes what they do in a chunk. A row has one value a lane,
/// lane_vectors vectors of them.
struct LaneBuffers {
    LaneNetworks networks;
    int vectors;          ///< that hold a running lane, 1 or lane_vectors; rows are as long in any case
    float* neurons;       ///< [source][lane]: inputs, then hidden neurons
    float* next_hidden;   ///< [hidden][lane]

    float* values;   ///< of the chunk, see LaneChunk
    std::uint16_t* words;
    float* x;
    float* y;
};

}   // namespace lore
