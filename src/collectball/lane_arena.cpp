#include "lane_arena.h"

#include <lore/collectball/geometry.h>

#include <algorithm>

namespace lore {

namespace {

std::vector<FaceLine> join_lines(std::vector<FacePair> const& pairs, std::vector<FaceInterval>& intervals) {
    std::vector<FaceLine> lines;
    std::vector<bool> taken(pairs.size(), false);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (taken[i]) continue;
        FaceLine line{pairs[i].upward, pairs[i].downward, static_cast<int>(intervals.size()), 0};
        for (std::size_t k = i; k < pairs.size(); ++k) {
            if (pairs[k].upward != line.upward || pairs[k].downward != line.downward) continue;
            taken[k] = true;
            intervals.push_back({pairs[k].lo, pairs[k].hi, pairs[k].door ? -1 : 0});
        }
        line.last = static_cast<int>(intervals.size());
        lines.push_back(line);
    }
    return lines;
}

}   // namespace

LaneArenaLayout::LaneArenaLayout(Arena const& arena) {
    Geometry const& g = *arena.geometry;
    vertical_ = join_lines(g.vertical, intervals_);
    horizontal_ = join_lines(g.horizontal, intervals_);
    view_.vertical = vertical_.data();
    view_.horizontal = horizontal_.data();
    view_.vertical_count = static_cast<int>(vertical_.size());
    view_.horizontal_count = static_cast<int>(horizontal_.size());
    view_.intervals = intervals_.data();
    view_.walls = g.walls.data();
    view_.wall_count = static_cast<int>(g.walls.size());
    view_.first_door = g.first_door;
    for (std::size_t i = 0; i < g.lights.size(); ++i)
        lights_.push_back({g.lights[i].x, g.lights[i].y, static_cast<std::int32_t>(1u << i)});
    view_.lights = lights_.data();
    view_.light_count = static_cast<int>(g.lights.size());
    view_.basket_mask = g.basket_mask;
    view_.switch_mask = g.switch_mask;
    view_.ball_mask = (1u << arena.task.ball_positions.size()) - 1u;
    static_assert(sizeof(Surroundings::Cell) == sizeof(std::uint64_t));
    Surroundings const& surroundings = g.surroundings();
    view_.cells = surroundings.cells.data();
    view_.columns = surroundings.columns;
    view_.rows = surroundings.rows;
    view_.open_offset = static_cast<int>(surroundings.open_offset);
    view_.cells_per_u = surroundings.cells_per_u;
    view_.always_asked = arena.reach <= arena.robot.radius ? 0 : view_.ball_mask | view_.switch_mask;
    view_.radius = arena.robot.radius;
    view_.radius_squared = g.radius_squared;
    view_.reach_squared = g.reach_squared;
    view_.max_speed = arena.robot.max_speed;
    view_.inverse_wheel_distance = g.inverse_wheel_distance;
    view_.sensor_range = arena.robot.sensor_range;
    view_.inverse_range = g.inverse_range;
    view_.cos_squared_half_view = g.cos_squared_half_view;
    view_.switch_pause = arena.task.switch_pause;
}

}   // namespace lore
