#pragma once

#include <lore/collectball/shapes.h>
#include <lore/collectball/wall_set.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lore {

/// What a robot in a cell of the arena can see and touch, so that a step need not ask every wall.
///
/// A light is clear in a cell if no wall can cross the segment from any of its points, mixed if only the exact test of
/// a point can say, and hidden otherwise. Everything is proven with a margin that covers rounding, so that table and
/// exact test together give what the exact test gives alone (tested).
struct Surroundings {
    /// Eight bytes, because steps jump about in the table and it should fit the cache.
    struct Cell {
        std::uint16_t clear = 0, mixed = 0;   ///< a bit a light, of the first 16; all further ones count as mixed
        WallSet suspects = 0;                 ///< walls that may hide a mixed light; no other can
        WallSet touchable = 0;                ///< walls that the disc may touch in a step that starts in the cell

        friend bool operator==(Cell const&, Cell const&) = default;
        std::uint32_t clear_lights() const { return clear; }
        std::uint32_t mixed_lights() const { return mixed | ~0xffffu; }
    };

    float cells_per_u = 0;   ///< 1 / edge of a cell [1/u]
    int columns = 0, rows = 0;
    std::size_t open_offset = 0;   ///< of the cells that hold while the door is open; 0 if there is no door
    std::vector<Cell> cells;       ///< [door state][row][column]

    /// Outside of the table everything is possible.
    Cell at(float x, float y, bool door_open) const {
        float const column = x * cells_per_u, row = y * cells_per_u;
        if (!(column >= 0.0f && row >= 0.0f && column < static_cast<float>(columns) && row < static_cast<float>(rows)))
            return {0, 0xffff, 0xffff, 0xffff};
        std::size_t const cell = static_cast<std::size_t>(static_cast<int>(row)) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(static_cast<int>(column));
        return cells[(door_open ? open_offset : 0) + cell];
    }
};

/// `walls` from number `first_door` on are doors that go away together. `touch_distance`: the robot's radius and the
/// longest way of a step [u]. At most 32 lights. Blocks of `block_cells` by `block_cells` cells are asked first, which
/// saves time; the table is the same with any number of them, 1 being each cell for itself.
Surroundings survey(float width, float height, std::span<Rect const> walls, int first_door,
                    std::span<Point const> lights, float touch_distance, int block_cells = 8);

}   // namespace lore
