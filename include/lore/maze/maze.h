#pragma once

#include <lore/episode/rules_world.h>
#include <lore/maze/rules.h>
#include <lore/world/open.h>

#include <array>
#include <string>
#include <vector>

namespace lore {

/// A maze as it is drawn.
struct MazePlan {
    std::string name;                          ///< an identifier: the task
    float width = 0, height = 0;               ///< [u]
    Position start, goal;                      ///< a robot at the start looks along x
    std::vector<std::array<float, 4>> walls;   ///< from x, y to x, y [u]; at most most_maze_walls
};

enum class MazeReward {
    way,   ///< each step what it gains of the first distance to the goal, so that all add up to 1 - last / first
           ///< distance, the objective whose deception the literature shows; and 1 for the goal
    goal   ///< only that 1
};

/// A robot that has to find its way through a maze, whose walls lead those astray that only come nearer to the goal:
/// the navigation task of the novelty-search literature (rules.h).
class MazeWorld final : public RulesWorld<MazeRules> {
public:
    explicit MazeWorld(MazePlan const&, MazeReward = MazeReward::way);
    std::string scene_svg() const override;
};

/// "medium" or "hard". Throws UsageError for another name.
MazePlan const& maze_plan(std::string const& name);

/// "maze" or "maze:TASK". Settings: `maze`, the task, "medium" unless it is named; `reward`, "way" or "goal".
extern BuiltinWorld const maze_world;

}   // namespace lore
