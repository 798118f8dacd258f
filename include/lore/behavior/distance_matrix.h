#pragma once

#include <lore/behavior/distances.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace lore {

/// All mutual distances of a pool, kept from one generation to the next for the survivors.
///
/// Symmetric with a zero diagonal, so that only pairs (i, j) with j < i are kept, row after row: the rows of a range
/// lie side by side, and a larger pool begins with the values of the smaller.
class DistanceMatrix {
public:
    DistanceMatrix() = default;
    explicit DistanceMatrix(int size) : size_(size), values_(pairs_before(size), 0.0) {}

    int size() const { return size_; }
    double operator()(int i, int j) const { return i == j ? 0.0 : row(std::max(i, j))[std::min(i, j)]; }
    /// Precondition: i != j.
    void set(int i, int j, double d) { row(std::max(i, j))[std::min(i, j)] = d; }
    /// The distances of member i to members 0 .. i-1.
    double* row(int i) { return values_.data() + pairs_before(i); }
    double const* row(int i) const { return values_.data() + pairs_before(i); }
    /// Rows [first, last), one after the other.
    std::span<double> rows(int first, int last) { return {row(first), row(last)}; }
    std::span<double const> rows(int first, int last) const { return {row(first), row(last)}; }

    /// The matrix of the chosen members, in that order. Precondition: each is chosen once.
    DistanceMatrix select(std::span<int const> members) const;
    /// The matrix of the members followed by `count` newcomers, whose distances are to be set. Takes the memory of
    /// a matrix that is no longer needed: of large ones, new memory would cost more than what is written there.
    DistanceMatrix extended(int count, DistanceMatrix spare) const;
    /// Mean distance of every member to the whole pool, itself included: BD(x). Each sum runs in pool order.
    std::vector<double> means() const;

    friend bool operator==(DistanceMatrix const&, DistanceMatrix const&) = default;

private:
    static std::size_t pairs_before(int row) { return static_cast<std::size_t>(row) * (std::max(row, 1) - 1) / 2; }

    int size_ = 0;
    std::vector<double> values_;
};

/// Every pair (i, j) with i in [first, last), j < i, of a pool, by distance(): the definition.
void measure_rows_plainly(DistanceKind, std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);
/// The fast path: every pair (i, j) with i in [first, last), j < i, of a pool, equal to distance() to the bit.
/// A pure function of the row range, so that ranks can share the rows. Chooses its instruction set at run time.
/// A kind that has no fast twin is measured plainly; of Euclidean ones nobody needs a matrix (mean_distances.h).
void measure_rows(DistanceKind, std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);

}   // namespace lore
