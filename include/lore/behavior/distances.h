#pragma once

#include <lore/behavior/descriptors.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lore {

enum class DistanceKind : std::uint8_t { adhoc, hamming, trajectory, entropy };
inline constexpr int distance_kinds = 4;
std::string_view name(DistanceKind);
DistanceKind distance_kind(std::string_view name);   ///< throws UsageError

/// Behavioural similarity measures d_1..d_4; symmetric, 0 for equal descriptors. Plain definitions.
double adhoc_distance(Descriptors const&, Descriptors const&);
/// Fraction of the bits (15 a step) that differ.
double hamming_distance(Descriptors const&, Descriptors const&);
/// Edit distance between tile sequences: insertion = deletion = 1, substitution (|dx| + |dy|) / 12, transposition of
/// neighbours at the substitution cost of the pair. Computed in whole twelfths, so that sums are exact.
double trajectory_distance(Descriptors const&, Descriptors const&);
double entropy_distance(Descriptors const&, Descriptors const&);
double distance(DistanceKind, Descriptors const&, Descriptors const&);

/// All mutual distances of a pool, kept from one generation to the next for those who survive.
///
/// Square, symmetric, zero diagonal; row-major [i][j].
class DistanceMatrix {
public:
    DistanceMatrix() = default;
    explicit DistanceMatrix(int size) : size_(size), values_(static_cast<std::size_t>(size) * size, 0.0) {}
    int size() const { return size_; }
    double operator()(int i, int j) const { return values_[static_cast<std::size_t>(i) * size_ + j]; }
    void set(int i, int j, double d) {
        values_[static_cast<std::size_t>(i) * size_ + j] = d;
        values_[static_cast<std::size_t>(j) * size_ + i] = d;
    }
    /// The matrix of the chosen members, in that order.
    DistanceMatrix select(std::span<int const> members) const;
    /// Mean distance of member i to the whole pool, itself included: BD(x). Summed in pool order.
    double mean(int i) const;

private:
    int size_ = 0;
    std::vector<double> values_;
};

/// The fast path: every pair (i, j) with i in [first, last), j < i, of a pool, equal to distance() to the bit.
/// A pure function of the row range, so that ranks can share the rows. Chooses its instruction set at run time.
void measure_rows(DistanceKind, std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix&);

} // namespace lore
