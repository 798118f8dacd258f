#pragma once

#include <lore/evolution/individual.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lore {

// Pareto functions on plain vectors (NSGA-II: Deb et al. 2002), maximizing. All points have equally many objectives,
// none of them NaN.

/// At least as good in every objective and better in one.
bool dominates(Objectives const& a, Objectives const& b);

/// Fronts of indices into `points`, best first; inside a front in increasing index. Every index is in one front.
std::vector<std::vector<int>> non_dominated_fronts(std::span<Objectives const> points);
/// The plain twin by definition, O(n^2 m) per front, for tests.
std::vector<std::vector<int>> non_dominated_fronts_plainly(std::span<Objectives const> points);

/// Crowding distance of each member of one front, in the order of `front`. Per objective the members are sorted by
/// value, equals by `tie_key[index into points]`; the two ends are infinite, the others add their neighbors'
/// difference over the front's range. An objective whose range in the front is 0 adds nothing and has no ends.
std::vector<double> crowding_distances(std::span<Objectives const> points, std::span<int const> front,
                                       std::span<std::uint64_t const> tie_key);

}   // namespace lore
