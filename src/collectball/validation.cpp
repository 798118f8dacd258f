#include "validation.h"

#include <lore/collectball/mechanics.h>

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace lore {

static_assert(most_turn_per_step == mechanics::most_turn);

namespace {

bool holds(Rect const& wall, Point const& p) {
    return wall.x0 <= p.x && p.x <= wall.x1 && wall.y0 <= p.y && p.y <= wall.y1;
}

/// The lines at which walls begin and end cut the plane in cells that are wholly wall or wholly free, so that a flood
/// over them finds every gap, however narrow.
class Plan {
public:
    explicit Plan(Arena const& arena) : walls_(arena.walls) {
        xs_ = {-1.0, 0.0, arena.width, arena.width + 1.0};
        ys_ = {-1.0, 0.0, arena.height, arena.height + 1.0};
        for (Rect const& wall : walls_) {
            xs_.insert(xs_.end(), {wall.x0, wall.x1});
            ys_.insert(ys_.end(), {wall.y0, wall.y1});
        }
        for (std::vector<double>* lines : {&xs_, &ys_}) {
            std::sort(lines->begin(), lines->end());
            lines->erase(std::unique(lines->begin(), lines->end()), lines->end());
        }
    }

    /// A place by which one gets from the start out of the arena; false if there is none. Doors count as open.
    bool escape(Pose const& start, Point& place) const {
        std::size_t const columns = xs_.size() - 1, rows = ys_.size() - 1;
        std::vector<bool> seen(columns * rows, false);
        std::vector<std::size_t> open{cell(ys_, start.y) * columns + cell(xs_, start.x)};
        while (!open.empty()) {
            std::size_t const at = open.back();
            open.pop_back();
            std::size_t const column = at % columns, row = at / columns;
            Point const middle{static_cast<float>((xs_[column] + xs_[column + 1]) / 2),
                               static_cast<float>((ys_[row] + ys_[row + 1]) / 2)};
            if (seen[at] || inside_wall(column, row)) continue;
            seen[at] = true;
            if (column == 0 || row == 0 || column + 1 == columns || row + 1 == rows) {
                place = middle;
                return true;
            }
            open.insert(open.end(), {at - 1, at + 1, at - columns, at + columns});
        }
        return false;
    }

private:
    static std::size_t cell(std::vector<double> const& lines, double at) {
        auto const after = std::upper_bound(lines.begin(), lines.end(), at) - lines.begin();
        return static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(lines.size()) - 2));
    }
    bool inside_wall(std::size_t column, std::size_t row) const {
        return std::any_of(walls_.begin(), walls_.end(), [&](Rect const& wall) {
            return wall.x0 <= xs_[column] && xs_[column + 1] <= wall.x1 && wall.y0 <= ys_[row] &&
                   ys_[row + 1] <= wall.y1;
        });
    }

    std::vector<Rect> const& walls_;
    std::vector<double> xs_, ys_;
};

}   // namespace

std::string why_unusable(Arena const& arena) {
    std::vector<Rect> walls = arena.walls;
    walls.insert(walls.end(), arena.doors.begin(), arena.doors.end());
    float const radius = arena.robot.radius;
    for (Rect const& wall : walls)
        if (mechanics::touches(wall, arena.start.x, arena.start.y, radius * radius))
            return fmt::format("the robot at its start ({}, {}) would touch a wall", arena.start.x, arena.start.y);

    auto const buried = [&](Point const& p) {
        return std::any_of(walls.begin(), walls.end(), [&](Rect const& wall) { return holds(wall, p); });
    };
    auto const misplaced = [&](std::string_view what, Point const& p) -> std::string {
        if (buried(p)) return fmt::format("{} at ({}, {}) lies inside a wall", what, p.x, p.y);
        if (!(p.x >= 0 && p.x <= arena.width && p.y >= 0 && p.y <= arena.height))
            return fmt::format("{} at ({}, {}) lies outside the arena", what, p.x, p.y);
        return {};
    };
    for (std::size_t i = 0; i < arena.task.ball_positions.size(); ++i)
        if (auto wrong = misplaced(fmt::format("ball {}", i), arena.task.ball_positions[i]); !wrong.empty())
            return wrong;
    for (std::size_t i = 0; i < arena.basket_lights.size(); ++i)
        if (auto wrong = misplaced(fmt::format("basket light {}", i), arena.basket_lights[i]); !wrong.empty())
            return wrong;
    if (auto wrong = misplaced("the switch", arena.switch_position); !wrong.empty()) return wrong;

    if (Point gap; Plan{arena}.escape(arena.start, gap))
        return fmt::format("it is not closed: one gets from the start out of it near ({}, {})", gap.x, gap.y);
    return {};
}

}   // namespace lore
