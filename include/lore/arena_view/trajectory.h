#pragma once

#include <lore/arena_view/scene.h>
#include <lore/figure/trajectory.h>

#include <cstdint>
#include <span>
#include <string>

namespace lore {

/// The robot of an arena along one evaluation.
struct RobotPath {
    std::span<Pose const> poses;              ///< before the move of each step
    std::span<std::uint8_t const> carrying;   ///< per step, 1 with a ball; as long as `poses`
};

/// The arena (walls dark, the door dashed, balls, basket with its lights, switch), the trajectory as draw_trajectory
/// has it for every world, and the robot every 50 steps, white or, with a ball, red. The picture's positions are those
/// of the poses.
std::string draw_trajectory(ArenaScene const&, RobotPath const&, TrajectoryPicture);

}   // namespace lore
