#include <lore/collectball/surroundings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lore {

namespace {

/// Cells are about this wide: 3 % of them are mixed in the paper's arena. Larger arenas get larger cells.
constexpr double cell_edge = 2.0;   // [u]
constexpr double most_cells = 1 << 16;
/// Everything is decided with cells and walls wrong by this much: far more than the rounding of positions and of the
/// exact test in float32 (1e-3 u) in arenas of thousands of u.
constexpr double margin = 0.05;   // [u]

struct Corner {
    double x, y;
};
struct Box {
    double x0, x1, y0, y1;
};

Box grown(Rect const& r, double by) { return {r.x0 - by, r.x1 + by, r.y0 - by, r.y1 + by}; }

/// True if the wall lies wholly on one side of the hull of the cell and the light, and so meets none of its points.
/// Separating axes: x, y, and the normals of the lines from the light to the cell's corners.
bool clear_of(Box const& wall, Box const& cell, Corner const& light) {
    if (wall.x1 < std::min(cell.x0, light.x) || wall.x0 > std::max(cell.x1, light.x) ||
        wall.y1 < std::min(cell.y0, light.y) || wall.y0 > std::max(cell.y1, light.y))
        return true;
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
        if (std::min(ax, bx) + std::min(ay, by) > cell_most || std::max(ax, bx) + std::max(ay, by) < cell_least)
            return true;
    }
    return false;
}

/// True if the wall meets the segment from the light to the corner.
bool blocks(Box const& wall, Corner const& corner, Corner const& light) {
    double const half_width = (wall.x1 - wall.x0) / 2, half_height = (wall.y1 - wall.y0) / 2;
    double const hx = (corner.x - light.x) / 2, hy = (corner.y - light.y) / 2;
    double const rx = (corner.x + light.x) / 2 - (wall.x0 + wall.x1) / 2;
    double const ry = (corner.y + light.y) / 2 - (wall.y0 + wall.y1) / 2;
    return std::abs(rx) <= half_width + std::abs(hx) && std::abs(ry) <= half_height + std::abs(hy) &&
           std::abs(hx * ry - hy * rx) <= half_width * std::abs(hy) + half_height * std::abs(hx);
}

/// The shadow of a convex wall is convex: if it holds the four corners of the cell, it holds the cell.
bool hidden_by(Box const& wall, Box const& cell, Corner const& light) {
    return wall.x0 < wall.x1 && wall.y0 < wall.y1 && blocks(wall, {cell.x0, cell.y0}, light) &&
           blocks(wall, {cell.x1, cell.y0}, light) && blocks(wall, {cell.x0, cell.y1}, light) &&
           blocks(wall, {cell.x1, cell.y1}, light);
}

/// A wall prepared for all proofs.
struct Obstacle {
    Box grown_wall, shrunk_wall;
    WallSet bit;
    bool door;
};

/// What the walls make of one light in one cell.
struct View {
    bool hidden = false;
    WallSet suspects = 0;   ///< if not hidden
};

using Obstacles = std::vector<Obstacle const*>;

View view(Obstacles const& obstacles, bool door_open, Box const& cell, Corner const& light) {
    View seen;
    for (Obstacle const* const o : obstacles) {
        if ((o->door && door_open) || clear_of(o->grown_wall, cell, light)) continue;
        if (hidden_by(o->shrunk_wall, cell, light)) return {true, 0};
        seen.suspects |= o->bit;
    }
    return seen;
}

/// Distance between two boxes.
double distance(Box const& a, Box const& b) {
    double const gap_x = std::max({a.x0 - b.x1, b.x0 - a.x1, 0.0}), gap_y = std::max({a.y0 - b.y1, b.y0 - a.y1, 0.0});
    return std::hypot(gap_x, gap_y);
}

/// What a block of cells can answer for all of them. A wall that is clear of the block, or hides it, or is out of its
/// touch, is so for each cell; so the cells ask few walls, and the table is made in an eighth of the time.
class Block {
public:
    Block(std::vector<Obstacle> const& walls, Box const& box, std::span<Point const> lights, double touch_distance)
        : lights_(lights), touch_distance_(touch_distance) {
        for (Point const& light : lights) asked_.push_back(obstacles(walls, box, {light.x, light.y}));
        for (Obstacle const& o : walls)
            if (distance(o.grown_wall, box) <= touch_distance) touchable_.push_back(&o);
    }

    /// The cell of the block that `box` is.
    Surroundings::Cell cell(Box const& box, bool door_open) const {
        Surroundings::Cell cell;
        if (lights_.size() > 16) cell.suspects = 0xffff;   // what hides a light without a bit of its own is not known
        for (std::size_t i = 0; i < lights_.size(); ++i) {
            if (!asked_[i]) continue;
            View const seen = view(*asked_[i], door_open, box, {lights_[i].x, lights_[i].y});
            if (seen.hidden) continue;
            if (i < 16) (seen.suspects == 0 ? cell.clear : cell.mixed) |= static_cast<std::uint16_t>(1u << i);
            cell.suspects |= seen.suspects;
        }
        for (Obstacle const* const o : touchable_)
            if (!(o->door && door_open) && distance(o->grown_wall, box) <= touch_distance_) cell.touchable |= o->bit;
        return cell;
    }

private:
    /// Those that may come between the block and the light; null if a wall hides all of the block.
    static std::optional<Obstacles> obstacles(std::vector<Obstacle> const& walls, Box const& box, Corner const& light) {
        Obstacles between;
        for (Obstacle const& o : walls) {
            if (clear_of(o.grown_wall, box, light)) continue;
            if (!o.door && hidden_by(o.shrunk_wall, box, light)) return std::nullopt;
            between.push_back(&o);
        }
        return between;
    }

    std::span<Point const> lights_;
    double touch_distance_;
    std::vector<std::optional<Obstacles>> asked_;   ///< [light]
    Obstacles touchable_;
};

}   // namespace

Surroundings survey(float width, float height, std::span<Rect const> walls, int first_door,
                    std::span<Point const> lights, float touch_distance, int block_cells) {
    Surroundings table;
    double const edge = std::max(cell_edge, std::sqrt(static_cast<double>(width) * height / most_cells));
    table.cells_per_u = static_cast<float>(1.0 / edge);
    table.columns = static_cast<int>(std::ceil(width / edge)) + 1;
    table.rows = static_cast<int>(std::ceil(height / edge)) + 1;
    bool const has_door = first_door < static_cast<int>(walls.size());
    std::size_t const count = static_cast<std::size_t>(table.columns) * static_cast<std::size_t>(table.rows);
    table.open_offset = has_door ? count : 0;
    table.cells.resize(count + table.open_offset);

    std::vector<Obstacle> obstacles;
    for (int i = 0; i < static_cast<int>(walls.size()); ++i) {
        Rect const& wall = walls[static_cast<std::size_t>(i)];
        obstacles.push_back({grown(wall, margin), grown(wall, -margin), wall_bit(i), i >= first_door});
    }
    auto const box_of = [&](int column, int row, int cells) {
        return Box{column * edge - margin, (column + cells) * edge + margin, row * edge - margin,
                   (row + cells) * edge + margin};
    };
    for (int top = 0; top < table.rows; top += block_cells)
        for (int left = 0; left < table.columns; left += block_cells) {
            Block const block{obstacles, box_of(left, top, block_cells), lights, touch_distance};
            for (int row = top; row < std::min(top + block_cells, table.rows); ++row)
                for (int column = left; column < std::min(left + block_cells, table.columns); ++column) {
                    std::size_t const at = static_cast<std::size_t>(row * table.columns + column);
                    Box const box = box_of(column, row, 1);
                    table.cells[at] = block.cell(box, !has_door);
                    if (has_door) table.cells[at + count] = block.cell(box, true);
                }
        }
    return table;
}

}   // namespace lore
