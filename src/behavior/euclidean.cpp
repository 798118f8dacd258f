#include "euclidean_kernel.h"

#include <lore/behavior/mean_distances.h>

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace lore {

namespace {

/// Points of equally many coordinates, column by column as the kernel reads them.
class Points {
public:
    /// A member's coordinates are the numbers of the field.
    template <class Number>
    Points(std::span<Descriptors const* const> pool, std::vector<Number> Descriptors::*field)
        : count_(pool.size()), coordinates_(pool.empty() ? 0 : (pool[0]->*field).size()),
          columns_(count_ * coordinates_), point_(coordinates_) {
        for (std::size_t i = 0; i < count_; ++i) {
            std::vector<Number> const& numbers = pool[i]->*field;
            assert(numbers.size() == coordinates_);
            for (std::size_t c = 0; c < coordinates_; ++c) columns_[c * count_ + i] = static_cast<double>(numbers[c]);
        }
    }

    int count() const { return static_cast<int>(count_); }

    /// distances[j]: of point i to every point j with first <= j < last; each is also added to sums[j].
    void measure(int i, int first, int last, double* distances, double* sums) {
        for (std::size_t c = 0; c < coordinates_; ++c) point_[c] = columns_[c * count_ + static_cast<std::size_t>(i)];
        kernel_.measure(point_.data(), columns_.data() + first, static_cast<int>(coordinates_), count(), last - first,
                        distances + first, sums + first);
    }

private:
    std::size_t count_, coordinates_;
    std::vector<double> columns_;   ///< [coordinate][point]
    std::vector<double> point_;     ///< the one that is measured
    EuclideanKernel kernel_ = kernel_for(active_isa(), LORE_KERNELS(euclidean))();
};

/// Each sum runs in the order of the points: a point is first summed over those before it, and then each later one adds
/// its distance. The sum over those before is a chain of additions; a block of points keeps several under way.
std::vector<double> means_of(Points points) {
    constexpr int block = 8;
    int const count = points.count();
    std::vector<double> sums(static_cast<std::size_t>(count), 0.0), distances(sums.size() * block);
    double* const rows = distances.data();
    for (int first = 0; first < count; first += block) {
        int const last = std::min(first + block, count);
        auto const row = [&](int i) { return rows + static_cast<std::ptrdiff_t>(i - first) * count; };
        for (int i = first; i < last; ++i) points.measure(i, 0, first, row(i), sums.data());
        double before[block] = {};   // a row that no point has any more is summed, too, and not used
        for (int j = 0; j < first; ++j)
            for (int k = 0; k < block; ++k) before[k] += rows[static_cast<std::ptrdiff_t>(k) * count + j];
        for (int i = first; i < last; ++i) {
            points.measure(i, first, i, row(i), sums.data());
            sums[i] = before[i - first];
            for (int j = first; j < i; ++j) sums[i] += row(i)[j];
        }
    }
    for (double& sum : sums) sum /= count;
    return sums;
}

}   // namespace

bool is_euclidean(DistanceKind kind) { return kind == DistanceKind::adhoc || kind == DistanceKind::entropy; }

std::vector<double> mean_distances(DistanceKind kind, std::span<Descriptors const* const> pool) {
    assert(is_euclidean(kind));
    return kind == DistanceKind::adhoc ? means_of({pool, &Descriptors::outcome})
                                       : means_of({pool, &Descriptors::entropies});
}

}   // namespace lore
