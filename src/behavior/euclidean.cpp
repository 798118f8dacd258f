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
            double* const row = matrix.row(i);
            for (int j = 0; j < i; ++j) row[j] = std::sqrt(squares[j]);
        }
    }

private:
    int count_, coordinates_;
    std::vector<double> columns_;   ///< [coordinate][point]
};

/// Rows [first, size) of the pool; the coordinates of a member are the numbers of the field.
template <class Number>
void measure_points(std::span<Descriptors const* const> pool, int first, std::vector<Number> Descriptors::*field,
                    DistanceMatrix& matrix) {
    std::size_t const coordinates = (pool[0]->*field).size();
    Points points(static_cast<int>(pool.size()), static_cast<int>(coordinates));
    for (std::size_t i = 0; i < pool.size(); ++i) {
        std::vector<Number> const& numbers = pool[i]->*field;
        assert(numbers.size() == coordinates);
        for (std::size_t c = 0; c < coordinates; ++c)
            points.coordinate(static_cast<int>(i), static_cast<int>(c)) = static_cast<double>(numbers[c]);
    }
    points.measure(first, matrix);
}

}   // namespace

void measure_adhoc_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    if (first >= last) return;
    measure_points(pool.first(static_cast<std::size_t>(last)), first, &Descriptors::outcome, matrix);
}

void measure_entropy_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    if (first >= last) return;
    measure_points(pool.first(static_cast<std::size_t>(last)), first, &Descriptors::entropies, matrix);
}

}   // namespace lore
