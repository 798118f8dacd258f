// The edit distance of one path to as many others as a vector has bytes. Compiled once per instruction set.
//
// With D(i, j) the cost of turning the first i tiles of the path into the first j of the other, only differences
// between neighboring cells are kept (the idea of Myers 1999, carried over from bits to bytes):
//
//   across(i, j)   = D(i, j) - D(i, j-1) - 12      in -24 .. 0
//   down(i, j)     = D(i, j) - D(i-1, j) - 12      in -24 .. 0
//   diagonal(i, j) = D(i, j) - D(i-1, j-1) - 24    in -24 .. -2
//
// All insertions and deletions cost 12, substitutions s at most 22, so the recurrence of distances.cpp becomes
//
//   diagonal(i, j) = min(across(i-1, j), down(i, j-1), s - 24, where transposed: s - 48 - diagonal(i-1, j-1))
//   down(i, j)     = diagonal(i, j) - across(i-1, j)
//   across(i, j)   = diagonal(i, j) - down(i, j-1)
//
// The ranges follow by induction: D never falls along a diagonal (for the transposition because diagonal(i-1, j-1) is
// at most the substitution of the same two tiles), and never rises by more than 12 between neighbors. A border of the
// matrix is 0, and so is a cell outside the band: 0 exceeds every s - 24, so it is never chosen.
#include "edit_kernel.h"

#include <lore/core/lanes.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES * static_cast<int>(sizeof(float));
using Bytes = Lanes<std::int8_t, width>;
using Counts = Lanes<std::uint8_t, width>;

LORE_INLINE Bytes load(std::int8_t const* from) { return lanes::load<Bytes>(from); }
LORE_INLINE Bytes least(Bytes const& a, Bytes const& b) { return a < b ? a : b; }

LORE_INLINE int distance_of(int a, int b) { return a < b ? b - a : a - b; }
LORE_INLINE int substitution_cost(int a, int b) {
    return distance_of(a % tiles_per_side, b % tiles_per_side) + distance_of(a / tiles_per_side, b / tiles_per_side);
}

constexpr int origin = -24;   // of diagonal differences and substitution costs: stands for 0

/// Sums of diagonal differences, one a lane. Bytes hold eleven of them (11 * 22 < 256) before they must be emptied.
class Tally {
public:
    LORE_INLINE explicit Tally(std::int32_t* costs) : costs_(costs) {
        for (int lane = 0; lane < width; ++lane) costs_[lane] = 0;
    }
    LORE_INLINE void add(Bytes const& differences) {
        sum_ += (Counts)(differences - static_cast<std::int8_t>(origin));
        if (++held_ == 11) close();
    }
    LORE_INLINE void close() {
        std::uint8_t sums[width];
        lanes::store(sums, sum_);
        for (int lane = 0; lane < width; ++lane) costs_[lane] += sums[lane];
        sum_ = Counts{};
        held_ = 0;
    }

private:
    std::int32_t* costs_;
    Counts sum_{};
    int held_ = 0;
};

LORE_INLINE std::int8_t* substitutions(PathGroup const& group, int tile) {
    return group.substitution + static_cast<std::ptrdiff_t>(tile) * (group.columns + 1) * width;
}

/// Row i of the matrix, columns [first, last].
template <bool transposable>
LORE_INLINE void advance(std::int8_t const* substitution, std::int8_t const* substitution_above, int transposition,
                         int first, int last, EditRows const& rows) {
    Bytes down{};
    Bytes diagonal_before = load(rows.diagonal + first * width);   // of the row above, one column to the left
    for (int j = first; j <= last; ++j) {
        std::ptrdiff_t const here = (j + 1) * width;
        Bytes const across = load(rows.across + here);
        Bytes const cost = load(substitution + here);
        Bytes best = least(across, cost);
        if constexpr (transposable) {
            auto const crossed =
                (load(substitution + here - width) == origin) & (load(substitution_above + here) == origin);
            best = least(best, (Bytes)crossed & (static_cast<std::int8_t>(transposition) - diagonal_before));
            diagonal_before = load(rows.diagonal + here);
        }
        Bytes const diagonal = least(best, down);
        lanes::store(rows.across + here, diagonal - down);
        lanes::store(rows.diagonal + here, diagonal);
        down = diagonal - across;
    }
}

LORE_INLINE void advance_row(PathGroup const& group, std::uint8_t const* path, int i, int first, int last,
                             EditRows const& rows) {
    std::int8_t const* const substitution = substitutions(group, path[i]);
    // Only where some lane left the present tile for the one before can a transposition apply; it never pays where both
    // are one tile, because then the substitution is free.
    if (i > 0 && path[i] != path[i - 1] && group.follows[path[i] * tile_count + path[i - 1]])
        advance<true>(substitution, substitutions(group, path[i - 1]),
                      substitution_cost(path[i], path[i - 1]) + 2 * origin, first, last, rows);
    else advance<false>(substitution, nullptr, 0, first, last, rows);
}

LORE_INLINE void clear(std::int8_t* rows, int columns) {
    for (int j = 0; j <= columns; ++j) lanes::store(rows + j * width, Bytes{});
}

void prepare(PathGroup const& group) {
    for (int k = 0; k < tile_count * tile_count; ++k) group.follows[k] = false;
    for (int j = 1; j < group.columns; ++j)
        for (int lane = 0; lane < width; ++lane)
            group.follows[group.tiles[(j - 1) * width + lane] * tile_count + group.tiles[j * width + lane]] = true;
    for (int tile = 0; tile < tile_count; ++tile) lanes::store(substitutions(group, tile), Bytes{});
    for (int j = 0; j < group.columns; ++j) {
        Bytes x, y;
        for (int lane = 0; lane < width; ++lane) {
            int const tile = group.tiles[j * width + lane];
            x[lane] = static_cast<std::int8_t>(tile % tiles_per_side);
            y[lane] = static_cast<std::int8_t>(tile / tiles_per_side);
        }
        for (int tile = 0; tile < tile_count; ++tile) {
            // As variables: under UBSan g++ takes the cast expressions for ints, which it will not narrow to bytes.
            std::int8_t const column = static_cast<std::int8_t>(tile % tiles_per_side);
            std::int8_t const row = static_cast<std::int8_t>(tile / tiles_per_side);
            Bytes const dx = x - column, dy = y - row;
            lanes::store(substitutions(group, tile) + (j + 1) * width,
                         (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy) + static_cast<std::int8_t>(origin));
        }
    }
}

void diagonal_costs(PathGroup const& group, std::uint8_t const* path, std::int32_t* costs) {
    Tally tally{costs};
    for (int j = 0; j < group.columns; ++j) tally.add(load(substitutions(group, path[j]) + (j + 1) * width));
    tally.close();
}

void banded_costs(PathGroup const& group, std::uint8_t const* path, int band, EditRows rows, std::int32_t* costs) {
    clear(rows.across, group.columns);
    clear(rows.diagonal, group.columns);
    Tally tally{costs};
    for (int i = 0; i < group.columns; ++i) {
        int const first = i > band ? i - band : 0;
        int const last = i + band < group.columns ? i + band : group.columns - 1;
        advance_row(group, path, i, first, last, rows);
        tally.add(load(rows.diagonal + (i + 1) * width));
    }
    tally.close();
}

void full_costs(PathGroup const& group, std::uint8_t const* path, int length, int const* lane_lengths, EditRows rows,
                std::int32_t* costs) {
    clear(rows.across, group.columns);
    clear(rows.diagonal, group.columns);
    for (int i = 0; i < length; ++i) advance_row(group, path, i, 0, group.columns - 1, rows);
    // D(length, j) from D(length, 0) along the last row, to the end of each lane's path.
    for (int lane = 0; lane < width; ++lane) {
        int cost = 12 * length;
        for (int j = 0; j < lane_lengths[lane]; ++j) cost += rows.across[(j + 1) * width + lane] + 12;
        costs[lane] = cost;
    }
}

}   // namespace

EditKernel edit() { return {width, prepare, diagonal_costs, banded_costs, full_costs}; }

}   // namespace lore::LORE_ISA_NAMESPACE
