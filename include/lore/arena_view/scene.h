#pragma once

#include <lore/collectball/shapes.h>

#include <string>
#include <string_view>
#include <vector>

namespace lore {

struct Arena;

/// What a picture shows of an arena and its task; lengths in [u], y grows downwards.
struct ArenaScene {
    float width = 0, height = 0;
    std::vector<Rect> walls;   ///< without the door
    std::vector<Rect> doors;   ///< parts of one door; empty without one
    std::vector<Point> ball_positions;
    bool balls_at_start = true;   ///< false: each comes with a press of the switch
    Point basket_center;
    float basket_radius = 0;
    std::vector<Point> basket_lights;
    Point switch_position;
    float robot_radius = 0;
    friend bool operator==(ArenaScene const&, ArenaScene const&) = default;
};

ArenaScene scene_of(Arena const&);

/// As scene.json keeps it (docs/manual/formats.md): a JSON object of numbers that read back to the same.
std::string to_json(ArenaScene const&);
/// Throws std::exception with the reason.
ArenaScene parse_arena_scene(std::string_view json);

}   // namespace lore
