#pragma once

#include <lore/core/isa.h>

namespace lore {

/// What the Euclidean distances need of an instruction set.
struct EuclideanKernel {
    /// distances[j]: of a point to the j-th of `count` others, which lie [coordinate][stride]; squares are summed in
    /// the order of the coordinates. Each is also added to sums[j].
    void (*measure)(double const* point, double const* others, int coordinates, int stride, int count,
                    double* distances, double* sums);
};

LORE_KERNEL(EuclideanKernel euclidean())

}   // namespace lore
