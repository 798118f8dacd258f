#include "euclidean_kernel.h"
#include "fast_distances.h"

#include <cassert>
#include <cmath>

namespace lore {

namespace {

/// Points of equally many coordinates, column by column as the kernel reads them.
class Points {
public:
    Points(int count, int coordinates)
        : count_(count), coordinates_(coordinates), columns_(static_cast<std::size_t>(count) * coordinates) {}

    double& coordinate(int point, int c) { return columns_[static_cast<std::size_t>(c) * count_ + point]; }

    void measure(int first, DistanceMatrix& matrix) {
        EuclideanKernel const kernel = kernel_for(active_isa(), LORE_KERNELS(euclidean))();
        std::vector<double> point(static_cast<std::size_t>(coordinates_)), squares(static_cast<std::size_t>(count_));
        for (int i = first; i < count_; ++i) {
            for (int c = 0; c < coordinates_; ++c) point[c] = coordinate(i, c);
            kernel.squares(point.data(), columns_.data(), coordinates_, count_, i, squares.data());
            for (int j = 0; j < i; ++j) matrix.set(i, j, std::sqrt(squares[j]));
        }
    }

private:
    int count_, coordinates_;
    std::vector<double> columns_;   ///< [coordinate][point]
};

}   // namespace

void measure_adhoc_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    if (first >= last) return;
    std::size_t const ball_count = pool[0]->ball_positions.size();
    Points points(last, static_cast<int>(2 * ball_count));
    for (int i = 0; i < last; ++i) {
        assert(pool[i]->ball_positions.size() == ball_count);
        for (std::size_t ball = 0; ball < ball_count; ++ball) {
            points.coordinate(i, static_cast<int>(2 * ball)) = pool[i]->ball_positions[ball].x;
            points.coordinate(i, static_cast<int>(2 * ball + 1)) = pool[i]->ball_positions[ball].y;
        }
    }
    points.measure(first, matrix);
}

void measure_entropy_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    Points points(last, channel_count);
    for (int i = 0; i < last; ++i)
        for (int c = 0; c < channel_count; ++c) points.coordinate(i, c) = pool[i]->entropies[c];
    points.measure(first, matrix);
}

}   // namespace lore
