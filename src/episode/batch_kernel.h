#pragma once

#include <lore/core/isa.h>
#include <lore/episode/lane_tick.h>

namespace lore {

/// What lives in batches need of an instruction set.
struct BatchKernel {
    /// tick_lanes for all vectors, or for the first alone.
    void (*tick)(LaneNetworks const&, int vectors, int inputs, int outputs, LaneNeurons const&, float* outputs_row);
};

LORE_KERNEL(BatchKernel batch())

}   // namespace lore
