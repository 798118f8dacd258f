#pragma once

#include <lore/evolution/individual.h>

#include <cstdint>
#include <span>
#include <string_view>
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

/// How points with two objectives are parted into fronts (docs/design/model.md, "As the predecessor did it").
enum class FrontsRule : std::uint8_t {
    dominance,   ///< non_dominated_fronts
    sweep        ///< fronts_by_sweep; points with one or three objectives: by dominance
};
std::string_view name(FrontsRule);
FrontsRule fronts_rule(std::string_view name);   ///< throws UsageError

/// The predecessor's fronts of points with two objectives: a sweep after Jensen (2003) that takes points in falling
/// order of the first objective, then of the second, equals by `tie_key[index]`. A point whose second objective is
/// larger than that of the last front's latest point joins the first front whose latest point is not larger in it;
/// otherwise it begins a front. Where no two points share a value these are the non-dominated fronts. Of equal points
/// in what was the last front, each later one begins a front of its own; and a point that shares its second objective
/// with the latest of a front joins it, though that one dominates it. Inside a front in increasing index.
std::vector<std::vector<int>> fronts_by_sweep(std::span<Objectives const> points,
                                              std::span<std::uint64_t const> tie_key);

/// How crowding_distances puts a front in order, and what its ends get.
struct CrowdingRules {
    /// Also an objective in which the whole front is equal has two ends.
    bool ends_among_equals = false;
    /// Equals stay in the order that sorting by the objectives before has left, at first that of `front`: what an
    /// insertion sort by one objective after the other does. Tie keys are not looked at, and values fall.
    bool insertion = false;
};

/// Whether member `a` stands before `b` after an insertion sort by the objectives 0 to `last`, one after the other,
/// each from the largest to the smallest value, of points in increasing index.
bool stands_before(std::span<Objectives const> points, int a, int b, int last);

/// Crowding distance of each member of one front, in the order of `front`. Per objective the members are sorted by
/// value, equals by `tie_key[index into points]`; the two ends are infinite, the others add their neighbors'
/// difference over the front's range. An objective whose range in the front is 0 adds nothing and has no ends, unless
/// the rules say so.
std::vector<double> crowding_distances(std::span<Objectives const> points, std::span<int const> front,
                                       std::span<std::uint64_t const> tie_key, CrowdingRules const& = {});

}   // namespace lore
