#pragma once

#include <lore/collectball/shapes.h>
#include <lore/core/lanes.h>

namespace lore {

/// A step counts as still if neither coordinate nor the heading changed by more than this (the predecessor's value).
inline constexpr float still_change = 1e-4f;   // [u], [rad]

/// Of one coordinate or the heading; a number, or one a lane.
template <class F>
LORE_INLINE auto stays(F const& before, F const& after) {
    return lanes::abs(F(after - before)) <= still_change;
}

inline bool is_still(Pose const& before, Pose const& after) {
    return stays(before.x, after.x) && stays(before.y, after.y) && stays(before.theta, after.theta);
}

}   // namespace lore
