#pragma once

#include <lore/behavior/distance_matrix.h>

#include <span>

namespace lore {

/// Pool in, rows of its distance matrix out. Evolution measures through this interface; a cluster shares the rows among
/// its ranks.
class DistanceMeasurer {
public:
    virtual ~DistanceMeasurer() = default;
    /// Sets every pair (i, j) with known <= i < pool.size() and j < i, and changes no other; values are those of
    /// measure_rows. The caller provides 0 <= known <= pool.size() and a matrix of at least pool.size() rows.
    virtual void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&) = 0;
};

/// Measures in this process.
class SerialMeasurer : public DistanceMeasurer {
public:
    void measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                 DistanceMatrix& matrix) override {
        measure_rows(kind, pool, known, static_cast<int>(pool.size()), matrix);
    }
};

}   // namespace lore
