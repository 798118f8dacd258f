#pragma once

#include <lore/collectball/arena.h>
#include <lore/collectball/channels.h>

#include <array>
#include <span>

namespace lore {

/// What a step changes in the robot's body.
struct RobotState {
    Pose pose;
    bool bumper_right = false;   ///< of the last attempted move
    bool bumper_left = false;
};

/// What a step changes in the world around it.
struct WorldState {
    std::uint16_t balls_mask = 0;   ///< bit i: ball i lies on the floor
    std::int8_t carried = -1;       ///< index of the ball in the robot's grip, or -1
    bool door_open = false;
    bool switch_lit = true;
    std::int16_t switch_timer = 0;   ///< steps until a pressed switch is lit again (tasks with a pause)
    std::int32_t collected = 0;      ///< balls delivered so far
    /// For each ball, where it was last released; its initial position if never taken, (0, 0) for a ball that a press
    /// of the switch brings. The adhoc behavior descriptor.
    std::array<Point, most_balls> released{};

    bool carrying() const { return carried >= 0; }
    friend bool operator==(WorldState const&, WorldState const&) = default;
};

using Sensors = std::array<float, sensor_count>;
using Effectors = std::array<float, effector_count>;

RobotState start_robot(Arena const&);
WorldState start_world(Arena const&);

/// Reads the sensors at the present pose. Plain definition; the lane twin agrees to the bit.
Sensors sense(Arena const&, RobotState const&, WorldState const&);
/// Pick up, release, press: at most one event a step.
void act(Arena const&, Pose const&, Effectors const&, WorldState&);
/// Moves along the exact arc, or stays where it is (keeping the new heading) if the disc would touch a wall.
void move(Arena const&, Effectors const&, WorldState const&, RobotState&);

}   // namespace lore
