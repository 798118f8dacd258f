#pragma once

#include <lore/collectball/shapes.h>

#include <cmath>

namespace lore {

/// A step counts as still if neither coordinate nor the heading changed by more than this (the predecessor's value).
inline constexpr float still_change = 1e-4f;   // [u], [rad]

inline bool is_still(Pose const& before, Pose const& after) {
    return std::abs(after.x - before.x) <= still_change && std::abs(after.y - before.y) <= still_change &&
           std::abs(after.theta - before.theta) <= still_change;
}

}   // namespace lore
