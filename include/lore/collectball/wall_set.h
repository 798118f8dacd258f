#pragma once

#include <lore/core/lanes.h>

#include <cstdint>

namespace lore {

/// A set of walls in half a word: bit i is Geometry::walls[i], and bit 15 stands for wall 15 and all that follow.
using WallSet = std::uint16_t;

inline constexpr int shared_wall_bit = 15;
constexpr WallSet wall_bit(int wall) {
    return static_cast<WallSet>(1u << (wall < shared_wall_bit ? wall : shared_wall_bit));
}

/// Calls visit(i) for every wall i < wall_count of the set, in increasing order.
template <class Visit>
LORE_INLINE void visit_walls(WallSet set, int wall_count, Visit&& visit) {
    for (unsigned left = set; left != 0; left &= left - 1) {
        int const wall = __builtin_ctz(left);
        if (wall >= wall_count) return;
        visit(wall);
        if (wall == shared_wall_bit)
            for (int i = wall + 1; i < wall_count; ++i) visit(i);
    }
}

}   // namespace lore
