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

/// Targets whose sums run side by side, in all vectors.
struct NeuronGroup {
    std::int32_t count;
    std::int32_t rounds;                                     ///< products added to each sum
    std::int32_t targets[lane_vectors][neuron_group_size];   ///< outputs, then hidden neurons
};

/// The lanes' networks laid over each other, those of each vector for themselves: of every target the sources that feed
/// it in any lane of the vector, in their order. The weight is 0 where a lane has no such edge, and where a target has
/// fewer sources than others of its group. That changes no sum: sources are never negative, so the product is +0, and
/// adding +0 to a sum that started from +0 gives that sum.
struct LaneNetworks {
    NeuronGroup const* groups;
    std::int32_t group_count, hidden_count;
    std::uint64_t const* sources;   ///< [group]: [round][vector], 16 bits a target: row of the source times its length
    float const* weights;           ///< [group]: [round][vector][target][lane], then biases [vector][target][lane]
};

/// Where a tick reads and writes. Rows are of lane_vectors vectors, one value a lane.
struct LaneNeurons {
    float* values;        ///< [source][lane]: inputs, then hidden neurons
    float* next_hidden;   ///< [hidden][lane]
};

namespace lane_tick {

/// Reads on from `sources` and `weights`.
template <int width, int vectors, int count>
LORE_INLINE void tick_group(NeuronGroup const& group, std::uint64_t const*& sources, float const*& weights, int outputs,
                            LaneNeurons const& neurons, float* outputs_row) {
    using F = Lanes<float, width>;
    constexpr int row = width * lane_vectors, block = width * count;
    F sums[vectors][count];
    for (auto& of_vector : sums)
        for (F& sum : of_vector) sum = F{};
    for (int round = 0; round < group.rounds; ++round, sources += lane_vectors, weights += lane_vectors * block)
        for (int v = 0; v < vectors; ++v) {
            float const* const values = neurons.values + v * width;
            for (int k = 0; k < count; ++k)
                sums[v][k] += lanes::load<F>(weights + v * block + k * width) *
                              lanes::load<F>(values + (sources[v] >> 16 * k & 0xffff));
        }
    for (int k = 0; k < count; ++k)
        for (int v = 0; v < vectors; ++v) {
            int const target = group.targets[v][k];
            float* const to =
                target < outputs ? outputs_row + target * row : neurons.next_hidden + (target - outputs) * row;
            F const bias = lanes::load<F>(weights + v * block + k * width);
            lanes::store(to + v * width, F(1.0f / (1.0f + math::exp(F(bias - sums[v][k])))));
        }
    weights += lane_vectors * block;
}

}   // namespace lane_tick

/// One tick of all lanes' networks (network/network.h) in native vectors of `width` lanes; the outputs go to one row
/// each. `vectors`: so many of lane_vectors hold a running lane.
template <int width, int vectors>
LORE_INLINE void tick_lanes(LaneNetworks const& networks, int inputs, int outputs, LaneNeurons const& neurons,
                            float* outputs_row) {
    using F = Lanes<float, width>;
    constexpr int row = width * lane_vectors;
    std::uint64_t const* sources = networks.sources;
    float const* weights = networks.weights;
    for (int g = 0; g < networks.group_count; ++g) {
        NeuronGroup const& group = networks.groups[g];
        static_assert(neuron_group_size == 4);
        switch (group.count) {
        case 4: lane_tick::tick_group<width, vectors, 4>(group, sources, weights, outputs, neurons, outputs_row); break;
        case 3: lane_tick::tick_group<width, vectors, 3>(group, sources, weights, outputs, neurons, outputs_row); break;
        case 2: lane_tick::tick_group<width, vectors, 2>(group, sources, weights, outputs, neurons, outputs_row); break;
        default:
            lane_tick::tick_group<width, vectors, 1>(group, sources, weights, outputs, neurons, outputs_row);
            break;
        }
    }
    float* const hidden = neurons.values + inputs * row;
    for (int h = 0; h < networks.hidden_count; ++h)
        for (int at = h * row; at < h * row + vectors * width; at += width)
            lanes::store(hidden + at, lanes::load<F>(neurons.next_hidden + at));
}

}   // namespace lore
