#pragma once

#include <lore/behavior/distances.h>

#include <span>
#include <vector>

namespace lore {

/// Whether a kind is a Euclidean distance between points of a few numbers. To measure one takes less time than to keep
/// it for the next generation: a matrix does not pay.
bool is_euclidean(DistanceKind);

/// Mean distance of members [first, last) of a pool to the whole pool, each itself included: BD(x), as means() of the
/// pool's DistanceMatrix has it to the bit, without the matrix. A pure function of the range, so that ranks can share
/// the pool. Preconditions: is_euclidean(kind), those of its distance, and 0 <= first <= last <= pool.size().
std::vector<double> mean_distances(DistanceKind, std::span<Descriptors const* const> pool, int first, int last);
/// Of every member.
inline std::vector<double> mean_distances(DistanceKind kind, std::span<Descriptors const* const> pool) {
    return mean_distances(kind, pool, 0, static_cast<int>(pool.size()));
}

}   // namespace lore
