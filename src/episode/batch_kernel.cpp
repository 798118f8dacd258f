#include "batch_kernel.h"

namespace lore::LORE_ISA_NAMESPACE {

namespace {

void tick(LaneNetworks const& networks, int vectors, int inputs, int outputs, LaneNeurons const& neurons,
          float* outputs_row) {
    if (vectors == 1) tick_lanes<LORE_LANES, 1>(networks, inputs, outputs, neurons, outputs_row);
    else tick_lanes<LORE_LANES, lane_vectors>(networks, inputs, outputs, neurons, outputs_row);
}

}   // namespace

BatchKernel batch() { return {tick}; }

}   // namespace lore::LORE_ISA_NAMESPACE
