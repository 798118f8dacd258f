#pragma once

#include <lore/core/lanes.h>
#include <lore/core/math.h>

#include <cstdint>

/// The networks of many lanes and their tick, for kernels: plain structs of pointers, and templates that are inlined
/// (tools/cmake/LoreTargets.cmake, lore_kernel). LaneNetworkLayout makes the structs.
namespace lore {

/// Vectors that one kernel advances together, phase by phase. A step is one long chain of dependent operations; while
/// one vector waits for its results the processor works on the other.
inline constexpr int lane_vectors = 2;

/// Most sums side by side: enough in flight to hide the latency of an addition.
inline constexpr int neuron_group_size = 4;

/// Targets of a network whose sums run side by side: one for each of `count` accumulators.
struct NeuronGroup {
    std::int32_t count;
    std::int32_t first_target;   ///< outputs, then hidden neurons
    std::int32_t first_entry, last_entry;
};

/// The lanes' networks laid over each other. An entry is a source that feeds, in any lane, a target of the group; its
/// weights are [target of group][lane of vector], 0 where a lane has no such edge. That changes no sum: sources are
/// never negative, so the product is +0, and adding +0 to a sum that started from +0 gives that sum.
struct LaneNetworks {
    NeuronGroup const* groups;
    std::int32_t group_count;
    std::int32_t const* sources;   ///< per entry: inputs, then hidden neurons
    std::int32_t const* offsets;   ///< per entry: of its weights
    float const* weights;          ///< one block a vector, so that a vector alone has it close together
    std::int32_t block_size;       ///< [floats]
    float const* biases;           ///< [target][lane]
    std::int32_t hidden_count;
};

/// Where a tick reads and writes. Rows are of lane_vectors vectors, one value a lane.
struct LaneNeurons {
    float* values;        ///< [source][lane]: inputs, then hidden neurons
    float* next_hidden;   ///< [hidden][lane]
};

namespace lane_tick {

template <int width, int vectors, int count>
LORE_INLINE void tick_group(LaneNetworks const& networks, NeuronGroup const& group, float const* values,
                            float* to_first) {
    using F = Lanes<float, width>;
    constexpr int row = width * lane_vectors;
    F sums[vectors][count];
    for (auto& of_vector : sums)
        for (F& sum : of_vector) sum = F{};
    for (int entry = group.first_entry; entry < group.last_entry; ++entry) {
        float const* const source = values + networks.sources[entry] * row;
        float const* const weights = networks.weights + networks.offsets[entry];
        for (int v = 0; v < vectors; ++v) {
            F const value = lanes::load<F>(source + v * width);
            float const* const own = weights + v * networks.block_size;
            for (int k = 0; k < count; ++k) sums[v][k] += lanes::load<F>(own + k * width) * value;
        }
    }
    float const* const biases = networks.biases + group.first_target * row;
    for (int k = 0; k < count; ++k)
        for (int v = 0; v < vectors; ++v) {
            int const at = k * row + v * width;
            F const bias = lanes::load<F>(biases + at);
            lanes::store(to_first + at, F(1.0f / (1.0f + math::exp(F(bias - sums[v][k])))));
        }
}

}   // namespace lane_tick

/// One tick of all lanes' networks (network/network.h) in native vectors of `width` lanes; the outputs go to one row
/// each. `vectors`: so many of lane_vectors hold a running lane.
template <int width, int vectors>
LORE_INLINE void tick_lanes(LaneNetworks const& networks, int inputs, int outputs, LaneNeurons const& neurons,
                            float* outputs_row) {
    using F = Lanes<float, width>;
    constexpr int row = width * lane_vectors;
    for (int g = 0; g < networks.group_count; ++g) {
        NeuronGroup const& group = networks.groups[g];
        float* const to = group.first_target < outputs ? outputs_row + group.first_target * row
                                                       : neurons.next_hidden + (group.first_target - outputs) * row;
        static_assert(neuron_group_size == 4);
        switch (group.count) {
        case 4: lane_tick::tick_group<width, vectors, 4>(networks, group, neurons.values, to); break;
        case 3: lane_tick::tick_group<width, vectors, 3>(networks, group, neurons.values, to); break;
        case 2: lane_tick::tick_group<width, vectors, 2>(networks, group, neurons.values, to); break;
        default: lane_tick::tick_group<width, vectors, 1>(networks, group, neurons.values, to); break;
        }
    }
    float* const hidden = neurons.values + inputs * row;
    for (int h = 0; h < networks.hidden_count; ++h)
        for (int at = h * row; at < h * row + vectors * width; at += width)
            lanes::store(hidden + at, lanes::load<F>(neurons.next_hidden + at));
}

}   // namespace lore
