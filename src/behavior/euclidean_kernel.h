#pragma once

#include <lore/core/isa.h>

namespace lore {

/// What the Euclidean distances need of an instruction set.
struct EuclideanKernel {
    /// squares[j]: squared distance of a point to the j-th of `count` others, which lie [coordinate][stride]; each sum
    /// runs over the coordinates in order.
    void (*squares)(double const* point, double const* others, int coordinates, int stride, int count, double* squares);
};

LORE_KERNEL(EuclideanKernel euclidean())

}   // namespace lore
