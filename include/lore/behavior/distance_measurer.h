#pragma once

#include <lore/behavior/distance_matrix.h>
#include <lore/behavior/mean_distances.h>

#include <span>
#include <vector>

namespace lore {

/// Pool in, distances out: rows of their matrix, or by Euclidean kinds only means. Evolution measures through this
/// interface; a cluster shares the members among its ranks.
class DistanceMeasurer {
public:
    virtual ~DistanceMeasurer() = default;
    /// Sets every pair (i, j) with known <= i < pool.size() and j < i, and changes no other; values are those of
    /// measure_rows. The caller provides 0 <= known <= pool.size() and a matrix of at least pool.size() rows.
    virtual void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&) = 0;
    /// What mean_distances gives. Precondition: the kind is Euclidean.
    virtual std::vector<double> means(DistanceKind, std::span<Descriptors const* const> pool) = 0;
};

/// Measures in this process.
class SerialMeasurer : public DistanceMeasurer {
public:
    void measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                 DistanceMatrix& matrix) override {
        measure_rows(kind, pool, known, static_cast<int>(pool.size()), matrix);
    }
    std::vector<double> means(DistanceKind kind, std::span<Descriptors const* const> pool) override {
        return mean_distances(kind, pool);
    }
};

}   // namespace lore
