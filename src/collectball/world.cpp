#include <lore/collectball/world.h>

#include <lore/collectball/geometry.h>
#include <lore/collectball/mechanics.h>

#include <algorithm>

namespace lore {

namespace {

/// Below it the effector that collects lets go.
constexpr float collecting_from = 0.5f;

float squared_distance(Point const& from, Point const& point) {
    float const dx = from.x - point.x, dy = from.y - point.y;
    return dx * dx + dy * dy;
}
float squared_distance(Pose const& pose, Point const& point) { return squared_distance(Point{pose.x, pose.y}, point); }

bool in_basket(Arena const& arena, Point const& position) {
    return squared_distance(position, arena.basket_center) <= arena.geometry->basket_radius_squared;
}

void release(Arena const& arena, Pose const& pose, WorldState& world) {
    world.released[static_cast<std::size_t>(world.carried)] = {pose.x, pose.y};
    world.carried = -1;
    if (in_basket(arena, {pose.x, pose.y})) ++world.collected;
}

/// The first ball in index order that lies within reach, or -1.
int ball_within_reach(Arena const& arena, Pose const& pose, WorldState const& world) {
    std::vector<Point> const& positions = arena.task.ball_positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
        if ((world.balls_mask >> i & 1u) != 0 && squared_distance(pose, positions[i]) < arena.geometry->reach_squared)
            return static_cast<int>(i);
    return -1;
}

void press_switch(Arena const& arena, WorldState& world) {
    world.switch_lit = false;
    world.switch_timer = static_cast<std::int16_t>(arena.task.switch_pause);
    if (arena.task.door == DoorRule::opens_with_switch) world.door_open = true;
    if (arena.task.ball_rule == BallRule::one_per_press) {
        std::uint32_t const absent = ~std::uint32_t{world.balls_mask} & ((1u << arena.task.ball_positions.size()) - 1u);
        world.balls_mask =
            static_cast<std::uint16_t>(world.balls_mask | (absent & (~absent + 1u)));   // the lowest that is absent
    }
}

}   // namespace

RobotState start_robot(Arena const& arena) { return {arena.start, false, false}; }

WorldState start_world(Arena const& arena) {
    WorldState world;
    world.door_open = arena.doors.empty();
    if (arena.task.ball_rule == BallRule::all_at_start) {
        std::vector<Point> const& positions = arena.task.ball_positions;
        world.balls_mask = static_cast<std::uint16_t>((1u << positions.size()) - 1u);
        std::copy(positions.begin(), positions.end(), world.released.begin());
    }
    return world;
}

Sensors sense(Arena const& arena, RobotState const& robot, WorldState const& world) {
    Geometry const& g = *arena.geometry;
    float const x = robot.pose.x, y = robot.pose.y;
    mechanics::Directions<float> const look = mechanics::directions(math::sincos(robot.pose.theta));
    auto const range = [&](mechanics::Vector<float> const& d) {
        return mechanics::range_value(cast_ray(g, x, y, d.x, d.y, world.door_open), arena.robot.sensor_range,
                                      g.inverse_range);
    };

    std::uint32_t const shining = world.balls_mask | g.basket_mask | (world.switch_lit ? g.switch_mask : 0u);
    std::uint32_t right = 0, left = 0;   // the lights in the field of view of each side
    for (std::size_t i = 0; i < g.lights.size(); ++i) {
        float const vx = g.lights[i].x - x, vy = g.lights[i].y - y;
        right |= std::uint32_t{mechanics::in_view(vx, vy, look.right, g.cos_squared_half_view) != 0} << i;
        left |= std::uint32_t{mechanics::in_view(vx, vy, look.left, g.cos_squared_half_view) != 0} << i;
    }
    std::uint32_t const visible = visible_lights(g, shining & (right | left), x, y, world.door_open);
    right &= visible;
    left &= visible;
    auto const on = [](bool condition) { return condition ? 1.0f : 0.0f; };
    std::uint32_t const ball_lights = ~(g.basket_mask | g.switch_mask);
    auto const sensors = std::to_array<float>({range(look.right), range(look.left), range(look.ahead),
                                               on((right & ball_lights) != 0), on((left & ball_lights) != 0),
                                               on((right & g.basket_mask) != 0), on((left & g.basket_mask) != 0),
                                               on((right & g.switch_mask) != 0), on((left & g.switch_mask) != 0),
                                               on(robot.bumper_right), on(robot.bumper_left), on(world.carrying())});
    static_assert(sensors.size() == sensor_count, "a value for every sensor, in the order of Channel");
    return sensors;
}

void act(Arena const& arena, Pose const& pose, Effectors const& effectors, WorldState& world) {
    if (arena.task.switch_pause > 0 && !world.switch_lit) {
        if (world.switch_timer > 0) --world.switch_timer;
        else world.switch_lit = true;
    }
    bool const collecting = effectors[effector_place(Channel::collect)] >= collecting_from;
    if (!collecting && world.carrying()) release(arena, pose, world);
    if (!collecting || world.carrying()) return;
    if (int const ball = ball_within_reach(arena, pose, world); ball >= 0) {
        world.carried = static_cast<std::int8_t>(ball);
        world.balls_mask = static_cast<std::uint16_t>(world.balls_mask & ~(1u << ball));
    } else if (world.switch_lit && squared_distance(pose, arena.switch_position) < arena.geometry->reach_squared) {
        press_switch(arena, world);
    }
}

void move(Arena const& arena, Effectors const& effectors, WorldState const& world, RobotState& robot) {
    Geometry const& g = *arena.geometry;
    mechanics::Drive<float> const drive = mechanics::drive(effectors[effector_place(Channel::left_wheel)],
                                                           effectors[effector_place(Channel::right_wheel)],
                                                           arena.robot.max_speed, g.inverse_wheel_distance);
    mechanics::Vector<float> const way = mechanics::arc(drive, math::sincos(robot.pose.theta));
    float const x = robot.pose.x + way.x, y = robot.pose.y + way.y;
    robot.pose.theta = mechanics::wrap(robot.pose.theta + drive.turn);
    robot.bumper_right = robot.bumper_left = false;
    if (!disc_touches(g, x, y, world.door_open)) {
        robot.pose.x = x;
        robot.pose.y = y;
        return;
    }
    math::SinCos<float> const heading = math::sincos(robot.pose.theta);
    std::size_t const walls = world.door_open ? static_cast<std::size_t>(g.first_door) : g.walls.size();
    for (std::size_t i = 0; i < walls; ++i) {
        if (!mechanics::touches(g.walls[i], x, y, g.radius_squared)) continue;
        auto const pressed = mechanics::bumpers(g.walls[i], x, y, heading, arena.robot.radius);
        robot.bumper_right |= pressed.right != 0;
        robot.bumper_left |= pressed.left != 0;
    }
}

}   // namespace lore
