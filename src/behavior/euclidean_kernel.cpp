// Euclidean distances of one point to many, a lane each. Compiled once per instruction set.
#include "euclidean_kernel.h"

#include <lore/core/lanes.h>

#include <cstddef>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

/// To as many others as F has lanes.
template <class F>
LORE_INLINE void measure_some(double const* point, double const* others, int coordinates, int stride, double* distances,
                              double* sums) {
    F square{};
    for (int c = 0; c < coordinates; ++c) {
        F const difference = point[c] - lanes::load<F>(others + c * static_cast<std::ptrdiff_t>(stride));
        square += difference * difference;
    }
    F const distance = lanes::sqrt(square);
    lanes::store(distances, distance);
    lanes::store(sums, F(lanes::load<F>(sums) + distance));
}

void measure(double const* point, double const* others, int coordinates, int stride, int count, double* distances,
             double* sums) {
    constexpr int width = LORE_LANES / 2;
    int j = 0;
    for (; j + width <= count; j += width)
        measure_some<Lanes<double, width>>(point, others + j, coordinates, stride, distances + j, sums + j);
    for (; j < count; ++j) measure_some<double>(point, others + j, coordinates, stride, distances + j, sums + j);
}

}   // namespace

EuclideanKernel euclidean() { return {measure}; }

}   // namespace lore::LORE_ISA_NAMESPACE
