#include <lore/behavior/distance_matrix.h>

#include "fast_distances.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace lore {

DistanceMatrix DistanceMatrix::select(std::span<int const> members) const {
    // In the order in which the members' rows lie here, so that each is read through once.
    std::vector<int> order(members.size());   // places among the chosen
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return members[a] < members[b]; });
    DistanceMatrix chosen(static_cast<int>(members.size()));
    for (std::size_t k = 0; k < order.size(); ++k) {
        double const* const distances = row(members[order[k]]);
        for (std::size_t m = 0; m < k; ++m) chosen.set(order[k], order[m], distances[members[order[m]]]);
    }
    return chosen;
}

DistanceMatrix DistanceMatrix::extended(int count, DistanceMatrix spare) const {
    spare.size_ = size_ + count;
    spare.values_.resize(pairs_before(spare.size_));
    std::copy(values_.begin(), values_.end(), spare.values_.begin());
    return spare;
}

std::vector<double> DistanceMatrix::means() const {
    // Rows in order: when row j is reached, the sum of member j takes it first, and later rows add one value each, so
    // that each sum runs in pool order. A row's own sum is a chain of additions; a block of rows keeps several under
    // way.
    constexpr int block = 8;
    std::vector<double> sums(static_cast<std::size_t>(size_), 0.0);
    for (int first = 0; first < size_; first += block) {
        double own[block] = {};
        double const* rows[block];
        for (int k = 0; k < block; ++k) rows[k] = row(std::min(first + k, size_ - 1));
        for (int i = 0; i < first; ++i)
            for (int k = 0; k < block; ++k) own[k] += rows[k][i];
        for (int j = first; j < std::min(first + block, size_); ++j) {
            double const* const distances = row(j);
            double sum = own[j - first];
            for (int i = first; i < j; ++i) sum += distances[i];
            sums[j] = sum;
            for (int i = 0; i < j; ++i) sums[i] += distances[i];
        }
    }
    for (double& sum : sums) sum /= size_;
    return sums;
}

void measure_rows(DistanceKind kind, std::span<Descriptors const* const> pool, int first, int last,
                  DistanceMatrix& matrix) {
    assert(0 <= first && last <= static_cast<int>(pool.size()) && last <= matrix.size());
    switch (kind) {
    case DistanceKind::hamming: return measure_hamming_rows(pool, first, last, matrix);
    case DistanceKind::trajectory: return measure_trajectory_rows(pool, first, last, matrix);
    default: return measure_rows_plainly(kind, pool, first, last, matrix);   // has no fast twin
    }
}

void measure_rows_plainly(DistanceKind kind, std::span<Descriptors const* const> pool, int first, int last,
                          DistanceMatrix& matrix) {
    for (int i = first; i < last; ++i)
        for (int j = 0; j < i; ++j) matrix.set(i, j, distance(kind, *pool[i], *pool[j]));
}

}   // namespace lore
