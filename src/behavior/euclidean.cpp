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

/// Of points [begin, end). Each sum runs in the order of the points: over those before `begin`, then over those among
/// which each pair is measured once, then over those from `end` on. Of a pair among them, the earlier point's sum takes
/// the distance at once, and the later point's when it has come so far; that is a chain of additions, and a block of
/// points keeps several under way.
std::vector<double> means_of(Points points, int begin, int end) {
    constexpr int block = 8;
    int const count = points.count();
    std::vector<double> sums(static_cast<std::size_t>(count), 0.0), distances(sums.size() * block);   // by point
    double* const rows = distances.data();
    for (int i = 0; i < begin; ++i) points.measure(i, begin, end, rows, sums.data());
    for (int first = begin; first < end; first += block) {
        int const last = std::min(first + block, end);
        auto const row = [&](int i) { return rows + static_cast<std::ptrdiff_t>(i - first) * count; };
        for (int i = first; i < last; ++i) points.measure(i, begin, first, row(i), sums.data());
        double before[block] = {};   // a row that no point has any more is summed, too, and not used
        std::copy(sums.begin() + first, sums.begin() + last, before);
        for (int j = begin; j < first; ++j)
            for (int k = 0; k < block; ++k) before[k] += rows[static_cast<std::ptrdiff_t>(k) * count + j];
        for (int i = first; i < last; ++i) {
            points.measure(i, first, i, row(i), sums.data());
            sums[i] = before[i - first];
            for (int j = first; j < i; ++j) sums[i] += row(i)[j];
        }
    }
    for (int i = end; i < count; ++i) points.measure(i, begin, end, rows, sums.data());
    std::vector<double> means(sums.begin() + begin, sums.begin() + end);
    for (double& mean : means) mean /= count;
    return means;
}

}   // namespace

bool is_euclidean(DistanceKind kind) { return kind == DistanceKind::adhoc || kind == DistanceKind::entropy; }

std::vector<double> mean_distances(DistanceKind kind, std::span<Descriptors const* const> pool, int first, int last) {
    assert(is_euclidean(kind) && 0 <= first && first <= last && last <= static_cast<int>(pool.size()));
    return kind == DistanceKind::adhoc ? means_of({pool, &Descriptors::outcome}, first, last)
                                       : means_of({pool, &Descriptors::entropies}, first, last);
}

}   // namespace lore
