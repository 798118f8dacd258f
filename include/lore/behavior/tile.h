#pragma once

#include <cstdint>

namespace lore {

inline constexpr int tiles_per_side = 12;   ///< the world's longer side is cut in 12; tiles are square

/// A square of the world, as the trajectory descriptor knows positions; x and y below tiles_per_side.
struct Tile {
    std::uint8_t x = 0, y = 0;
    friend bool operator==(Tile const&, Tile const&) = default;
};

}   // namespace lore
