#pragma once

#include <lore/behavior/distances.h>

#include <span>
#include <vector>

namespace lore {

/// All mutual distances of a pool, kept from one generation to the next for the survivors.
///
/// Square, symmetric, zero diagonal; row-major [i][j].
class DistanceMatrix {
public:
    DistanceMatrix() = default;
    explicit DistanceMatrix(int size) : size_(size), values_(static_cast<std::size_t>(size) * size, 0.0) {}

    int size() const { return size_; }
    double operator()(int i, int j) const { return values_[index(i, j)]; }
    void set(int i, int j, double d) {
        values_[index(i, j)] = d;
        values_[index(j, i)] = d;
    }

    /// The matrix of the chosen members, in that order.
    DistanceMatrix select(std::span<int const> members) const;
    /// The matrix of the members followed by `count` newcomers, whose distances are still 0.
    DistanceMatrix extended(int count) const;
    /// Mean distance of every member to the whole pool, itself included: BD(x). Each sum runs in pool order.
    std::vector<double> means() const;

    friend bool operator==(DistanceMatrix const&, DistanceMatrix const&) = default;

private:
    std::size_t index(int i, int j) const { return static_cast<std::size_t>(i) * size_ + j; }

    int size_ = 0;
    std::vector<double> values_;
};

/// Every pair (i, j) with i in [first, last), j < i, of a pool, by distance(): the definition.
void measure_rows_plainly(DistanceKind, std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);
/// The fast path: every pair (i, j) with i in [first, last), j < i, of a pool, equal to distance() to the bit.
/// A pure function of the row range, so that ranks can share the rows. Chooses its instruction set at run time.
/// A kind that has no fast twin is measured plainly.
void measure_rows(DistanceKind, std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);

}   // namespace lore
