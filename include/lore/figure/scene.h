#pragma once

#include <lore/arena/shapes.h>

#include <vector>

namespace lore {

struct Arena;

/// What a picture shows of an arena and its task; lengths in [u], y grows downwards.
struct Scene {
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
    friend bool operator==(Scene const&, Scene const&) = default;
};

Scene scene_of(Arena const&);

}   // namespace lore
