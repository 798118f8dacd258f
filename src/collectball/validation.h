#pragma once

#include <lore/collectball/arena.h>

#include <string>

namespace lore {

/// The robot's motion is computed by series that are exact up to this turn [rad] (collectball/mechanics.h).
inline constexpr double most_turn_per_step = 0.5;

/// Why no robot could be simulated in this arena, or "": it is not closed, or something lies inside a wall.
std::string why_unusable(Arena const&);

}   // namespace lore
