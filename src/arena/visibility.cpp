#include <lore/arena/visibility.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lore {

namespace {

/// Cells are about this wide: 3 % of them are mixed in the paper's arena. Larger arenas get larger cells.
constexpr double cell_edge = 2.0;          // [u]
constexpr double most_cells = 1 << 16;
/// Everything is decided with cells and walls wrong by this much: far more than the rounding of positions and of the
/// exact test in float32 (1e-3 u) in arenas of thousands of u.
constexpr double margin = 0.05;            // [u]

struct Corner { double x, y; };
struct Box { double x0, x1, y0, y1; };

Box grown(Rect const& r, double by) { return {r.x0 - by, r.x1 + by, r.y0 - by, r.y1 + by}; }

/// True if the wall lies wholly on one side of the hull of the cell and the light, and so meets none of its points.
/// Separating axes: x, y, and the normals of the lines from the light to the cell's corners.
bool clear_of(Box const& wall, Box const& cell, Corner const& light) {
    if (wall.x1 < std::min(cell.x0, light.x) || wall.x0 > std::max(cell.x1, light.x)
        || wall.y1 < std::min(cell.y0, light.y) || wall.y0 > std::max(cell.y1, light.y)) return true;
    std::array<Corner, 4> const hull{{{cell.x0, cell.y0}, {cell.x1, cell.y0}, {cell.x0, cell.y1}, {cell.x1, cell.y1}}};
    for (Corner const& corner : hull) {
        double const nx = corner.y - light.y, ny = light.x - corner.x;
        double cell_least = 0, cell_most = 0;   // of the normal's product; the light's own is 0
        for (Corner const& c : hull) {
            double const p = nx * (c.x - light.x) + ny * (c.y - light.y);
            cell_least = std::min(cell_least, p);
            cell_most = std::max(cell_most, p);
        }
        double const ax = nx * (wall.x0 - light.x), bx = nx * (wall.x1 - light.x);
        double const ay = ny * (wall.y0 - light.y), by = ny * (wall.y1 - light.y);
        if (std::min(ax, bx) + std::min(ay, by) > cell_most || std::max(ax, bx) + std::max(ay, by) < cell_least) return true;
    }
    return false;
}

/// True if the wall meets the segment from the light to the corner.
bool blocks(Box const& wall, Corner const& corner, Corner const& light) {
    double const half_width = (wall.x1 - wall.x0) / 2, half_height = (wall.y1 - wall.y0) / 2;
    double const hx = (corner.x - light.x) / 2, hy = (corner.y - light.y) / 2;
    double const rx = (corner.x + light.x) / 2 - (wall.x0 + wall.x1) / 2;
    double const ry = (corner.y + light.y) / 2 - (wall.y0 + wall.y1) / 2;
    return std::abs(rx) <= half_width + std::abs(hx) && std::abs(ry) <= half_height + std::abs(hy)
        && std::abs(hx * ry - hy * rx) <= half_width * std::abs(hy) + half_height * std::abs(hx);
}

/// The shadow of a convex wall is convex: if it holds the four corners of the cell, it holds the cell.
bool hidden_by(Box const& wall, Box const& cell, Corner const& light) {
    return wall.x0 < wall.x1 && wall.y0 < wall.y1 && blocks(wall, {cell.x0, cell.y0}, light) && blocks(wall, {cell.x1, cell.y0}, light)
        && blocks(wall, {cell.x0, cell.y1}, light) && blocks(wall, {cell.x1, cell.y1}, light);
}

/// Walls prepared for both proofs.
struct Walls {
    std::vector<Box> grown_walls, shrunk_walls;
    explicit Walls(std::span<Rect const> walls) {
        for (Rect const& wall : walls) {
            grown_walls.push_back(grown(wall, margin));
            shrunk_walls.push_back(grown(wall, -margin));
        }
    }
};

enum class View { clear, mixed, hidden };

View view(Walls const& walls, Box const& cell, Corner const& light) {
    View seen = View::clear;
    for (std::size_t i = 0; i < walls.grown_walls.size(); ++i) {
        if (clear_of(walls.grown_walls[i], cell, light)) continue;
        if (hidden_by(walls.shrunk_walls[i], cell, light)) return View::hidden;
        seen = View::mixed;
    }
    return seen;
}

} // namespace

VisibilityTable tabulate_visibility(float width, float height, std::span<Rect const> walls, std::span<Rect const> doors,
                                    std::span<Point const> lights) {
    VisibilityTable table;
    double const edge = std::max(cell_edge, std::sqrt(static_cast<double>(width) * height / most_cells));
    table.cells_per_u = static_cast<float>(1.0 / edge);
    table.columns = static_cast<int>(std::ceil(width / edge)) + 1;
    table.rows = static_cast<int>(std::ceil(height / edge)) + 1;
    std::size_t const words = 2 * static_cast<std::size_t>(table.columns) * static_cast<std::size_t>(table.rows);
    table.open_offset = doors.empty() ? 0 : words;
    table.words.assign(words + table.open_offset, 0);

    Walls const standing{walls}, opening{doors};
    std::size_t word = 0;
    for (int row = 0; row < table.rows; ++row)
        for (int column = 0; column < table.columns; ++column, word += 2) {
            Box const cell{column * edge - margin, (column + 1) * edge + margin, row * edge - margin, (row + 1) * edge + margin};
            for (std::size_t i = 0; i < lights.size(); ++i) {
                Corner const light{lights[i].x, lights[i].y};
                View const open = view(standing, cell, light);
                View const shut = open == View::hidden ? open : std::max(open, view(opening, cell, light));
                auto const note = [&](std::size_t at, View seen) {
                    if (seen == View::clear) table.words[at] |= 1u << i;
                    if (seen == View::mixed) table.words[at + 1] |= 1u << i;
                };
                note(word, shut);
                if (table.open_offset != 0) note(word + table.open_offset, open);
            }
        }
    return table;
}

} // namespace lore
