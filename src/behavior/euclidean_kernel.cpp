// Squared Euclidean distances of one point to many, a lane each. Compiled once per instruction set.
#include "euclidean_kernel.h"

#include <lore/core/lanes.h>

#include <cstddef>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

template <class F>
LORE_INLINE F square(double const* point, double const* others, int coordinates, int stride) {
    F sum{};
    for (int c = 0; c < coordinates; ++c) {
        F const difference = point[c] - lanes::load<F>(others + c * static_cast<std::ptrdiff_t>(stride));
        sum += difference * difference;
    }
    return sum;
}

void squares(double const* point, double const* others, int coordinates, int stride, int count, double* squares) {
    constexpr int width = LORE_LANES / 2;
    int j = 0;
    for (; j + width <= count; j += width)
        lanes::store(squares + j, square<Lanes<double, width>>(point, others + j, coordinates, stride));
    for (; j < count; ++j) squares[j] = square<double>(point, others + j, coordinates, stride);
}

}   // namespace

EuclideanKernel euclidean() { return {squares}; }

}   // namespace lore::LORE_ISA_NAMESPACE
