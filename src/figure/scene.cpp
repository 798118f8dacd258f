#include <lore/figure/scene.h>

#include <lore/arena/arena.h>

namespace lore {

Scene scene_of(Arena const& arena) {
    return {.width = arena.width,
            .height = arena.height,
            .walls = arena.walls,
            .doors = arena.doors,
            .ball_positions = arena.task.ball_positions,
            .balls_at_start = arena.task.ball_rule == BallRule::all_at_start,
            .basket_center = arena.basket_center,
            .basket_radius = arena.basket_radius,
            .basket_lights = arena.basket_lights,
            .switch_position = arena.switch_position,
            .robot_radius = arena.robot.radius};
}

}   // namespace lore
