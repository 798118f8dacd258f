#pragma once

#include <lore/behavior/distance_matrix.h>

namespace lore {

// The fast twins behind measure_rows, each with its contract.
void measure_hamming_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);
void measure_trajectory_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);

/// A cache line, so that vectors of them hold aligned lanes of any width.
struct alignas(64) CacheLine {
    std::byte bytes[64];
};

}   // namespace lore
