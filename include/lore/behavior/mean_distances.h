#pragma once

#include <lore/behavior/distances.h>

#include <span>
#include <vector>

namespace lore {

/// Whether a kind is a Euclidean distance between points of a few numbers. To measure one takes less time than to keep
/// it for the next generation: a matrix does not pay.
bool is_euclidean(DistanceKind);

/// Mean distance of every member of a pool to the whole pool, itself included: BD(x), the means() of the pool's
/// DistanceMatrix to the bit, without the matrix. Preconditions: is_euclidean(kind), and those of its distance.
std::vector<double> mean_distances(DistanceKind kind, std::span<Descriptors const* const> pool);

}   // namespace lore
