#include <lore/behavior/distance_matrix.h>

#include "fast_distances.h"

#include <algorithm>
#include <cassert>

namespace lore {

DistanceMatrix DistanceMatrix::select(std::span<int const> members) const {
    DistanceMatrix chosen(static_cast<int>(members.size()));
    double* out = chosen.values_.data();
    for (int const i : members) {
        double const* const row = values_.data() + index(i, 0);
        for (int const j : members) *out++ = row[j];
    }
    return chosen;
}

DistanceMatrix DistanceMatrix::extended(int count) const {
    DistanceMatrix longer(size_ + count);
    for (int i = 0; i < size_; ++i)
        std::copy_n(values_.data() + index(i, 0), size_, longer.values_.data() + longer.index(i, 0));
    return longer;
}

std::vector<double> DistanceMatrix::means() const {
    // Row by row into all sums at once: the matrix is symmetric, so each sum still runs in pool order, and the compiler
    // adds many of them side by side.
    std::vector<double> sums(static_cast<std::size_t>(size_), 0.0);
    for (int j = 0; j < size_; ++j) {
        double const* const row = values_.data() + index(j, 0);
        for (int i = 0; i < size_; ++i) sums[i] += row[i];
    }
    for (double& sum : sums) sum /= size_;
    return sums;
}

void measure_rows(DistanceKind kind, std::span<Descriptors const* const> pool, int first, int last,
                  DistanceMatrix& matrix) {
    assert(0 <= first && last <= static_cast<int>(pool.size()) && last <= matrix.size());
    switch (kind) {
    case DistanceKind::adhoc: return measure_adhoc_rows(pool, first, last, matrix);
    case DistanceKind::hamming: return measure_hamming_rows(pool, first, last, matrix);
    case DistanceKind::trajectory: return measure_trajectory_rows(pool, first, last, matrix);
    case DistanceKind::entropy: return measure_entropy_rows(pool, first, last, matrix);
    default: return measure_rows_plainly(kind, pool, first, last, matrix);   // has no fast twin yet
    }
}

void measure_rows_plainly(DistanceKind kind, std::span<Descriptors const* const> pool, int first, int last,
                          DistanceMatrix& matrix) {
    for (int i = first; i < last; ++i)
        for (int j = 0; j < i; ++j) matrix.set(i, j, distance(kind, *pool[i], *pool[j]));
}

}   // namespace lore
