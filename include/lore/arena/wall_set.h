#pragma once

#include <lore/core/lanes.h>

#include <cstdint>

namespace lore {

/// A set of walls in one word: bit i is Geometry::walls[i], and bit 31 stands for wall 31 and all that follow.
using WallSet = std::uint32_t;

constexpr WallSet wall_bit(int wall) { return 1u << (wall < 31 ? wall : 31); }

/// Calls visit(i) for every wall i < wall_count of the set, in increasing order.
template <class Visit>
LORE_INLINE void visit_walls(WallSet set, int wall_count, Visit&& visit) {
    for (; set != 0; set &= set - 1) {
        int const wall = __builtin_ctz(set);
        if (wall >= wall_count) return;
        visit(wall);
        if (wall == 31)
            for (int i = 32; i < wall_count; ++i) visit(i);
    }
}

} // namespace lore
