#pragma once

#include <lore/behavior/tile.h>
#include <lore/core/isa.h>

#include <cstdint>

namespace lore {

inline constexpr int tile_count = tiles_per_side * tiles_per_side;
constexpr int tile_index(Tile tile) { return tile.y * tiles_per_side + tile.x; }

/// Paths side by side, a lane each, as the edit distance kernel reads them. All memory is the caller's.
struct PathGroup {
    std::uint8_t const* tiles;   ///< [column][lane]: tile_index; a shorter path is padded with any tile
    int columns;                 ///< length of the longest path
    /// [tile][1 + column][lane]: substitution cost of a tile and the lane's tile, minus 24 [twelfths]; column -1 is 0.
    std::int8_t* substitution;
    /// [tile][tile]: whether in some lane the first is left for the second.
    bool* follows;
};

/// Rows in progress: [1 + column][lane] each.
struct EditRows {
    std::int8_t* across;
    std::int8_t* diagonal;
};

/// The kernel compiled for one instruction set.
struct EditKernel {
    int lanes;   ///< paths in a group: bytes in a native vector
    /// Fills substitution and follows.
    void (*prepare)(PathGroup const&);
    /// Sum of the substitution costs of the path and each lane's, step by step: at least their distance [twelfths].
    /// Precondition: equal lengths.
    void (*diagonal_costs)(PathGroup const&, std::uint8_t const* path, std::int32_t* costs);
    /// Edit distances [twelfths] of the path to each lane's, of equal lengths, by scripts that stay within
    /// |i - j| <= band.
    void (*banded_costs)(PathGroup const&, std::uint8_t const* path, int band, EditRows, std::int32_t* costs);
    /// The same for any lengths and all scripts.
    void (*full_costs)(PathGroup const&, std::uint8_t const* path, int length, int const* lane_lengths, EditRows,
                       std::int32_t* costs);
};

LORE_KERNEL(EditKernel edit())

}   // namespace lore
