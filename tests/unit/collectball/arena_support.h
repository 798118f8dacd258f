#pragma once

#include <lore/collectball/geometry.h>

#include <stdexcept>
#include <string>

namespace lore::tests {

/// Replaces the one occurrence of `from`.
inline std::string replaced(std::string text, std::string const& from, std::string const& to) {
    std::size_t const at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the text lacks: " + from);
    return text.replace(at, from.size(), to);
}

/// A room of 200 x 200 u with walls of 10 u, lights in its corners, and the given walls and doors besides.
inline Arena room(std::vector<Rect> const& more_walls = {}, std::vector<Rect> const& doors = {}) {
    Arena arena;
    arena.name = "room";
    arena.width = arena.height = 200;
    arena.walls = {{0, 10, 0, 200}, {190, 200, 0, 200}, {0, 200, 0, 10}, {0, 200, 190, 200}};
    arena.walls.insert(arena.walls.end(), more_walls.begin(), more_walls.end());
    arena.doors = doors;
    arena.basket_lights = {{20, 180}};
    arena.basket_center = {20, 200};
    arena.basket_radius = 30;
    arena.switch_position = {180, 20};
    arena.start = {100, 100, 0};
    arena.task.ball_positions = {{20, 20}, {180, 180}};
    compile_geometry(arena);
    return arena;
}

}   // namespace lore::tests
