#pragma once

#include <lore/arena/shapes.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lore {

/// From which cells of the arena which light is visible: a bit a light in two words a cell.
///
/// A light is clear in a cell if no wall can cross the segment from any of its points, mixed if only the exact test of
/// a point can say, and hidden otherwise. The classification is proven with a margin that covers rounding, so that
/// table and exact test together give what the exact test gives alone (tested).
struct VisibilityTable {
    float cells_per_u = 0;            ///< 1 / edge of a cell [1/u]
    int columns = 0, rows = 0;
    std::size_t open_offset = 0;      ///< of the words that hold while the door is open; 0 if there is no door
    std::vector<std::uint32_t> words; ///< [door state][row][column]{clear, mixed}

    struct Lights { std::uint32_t clear, mixed; };
    /// Outside of the table everything is mixed.
    Lights at(float x, float y, bool door_open) const {
        float const column = x * cells_per_u, row = y * cells_per_u;
        if (!(column >= 0.0f && row >= 0.0f && column < static_cast<float>(columns) && row < static_cast<float>(rows)))
            return {0, ~0u};
        std::size_t const cell = static_cast<std::size_t>(static_cast<int>(row)) * static_cast<std::size_t>(columns)
                               + static_cast<std::size_t>(static_cast<int>(column));
        std::size_t const word = (door_open ? open_offset : 0) + 2 * cell;
        return {words[word], words[word + 1]};
    }
};

/// `doors` are walls that go away together. At most 32 lights.
VisibilityTable tabulate_visibility(float width, float height, std::span<Rect const> walls, std::span<Rect const> doors,
                                    std::span<Point const> lights);

} // namespace lore
