#include <lore/maze/maze.h>

#include <lore/core/error.h>
#include <lore/core/names.h>
#include <lore/core/toml.h>

#include "lane_kernel.h"

#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr auto reward_names = names_for<MazeReward>("way", "goal");

WorldFacts facts_of(MazePlan const& plan) {
    WorldFacts facts;
    facts.name = "maze";
    facts.task = plan.name;
    facts.reward_unit = "way";
    for (char const* name : {"range_left", "range_front_left", "range_front", "range_front_right", "range_right",
                             "range_back", "goal_front", "goal_right", "goal_back", "goal_left"})
        facts.sensors.push_back({name, MazeRules::binary[facts.sensors.size()]});
    facts.effectors = {{"turn", false}, {"thrust", false}};
    facts.outcome_size = 2;
    facts.width = plan.width;
    facts.height = plan.height;
    return facts;
}

MazeRules rules_of(MazePlan const& plan, MazeReward reward) {
    assert(plan.walls.size() <= most_maze_walls);
    MazeRules rules{};
    for (auto const& [x0, y0, x1, y1] : plan.walls) {
        float const way_x = x1 - x0, way_y = y1 - y0, square = way_x * way_x + way_y * way_y;
        rules.walls[rules.wall_count++] = {x0, y0, x1, y1, way_x, way_y, way_x / square, way_y / square};
    }
    rules.start_x = plan.start.x;
    rules.start_y = plan.start.y;
    rules.goal_x = plan.goal.x;
    rules.goal_y = plan.goal.y;
    float const dx = plan.goal.x - plan.start.x, dy = plan.goal.y - plan.start.y;
    rules.start_distance = std::sqrt(dx * dx + dy * dy);
    rules.reward_of_way = reward == MazeReward::way ? 1 / rules.start_distance : 0;
    return rules;
}

std::unique_ptr<World> open_maze(std::string const& task, std::string const& settings) {
    TomlTable const table = TomlTable::parse(settings, "[world.settings] of maze");
    auto const maze = table.string("maze"), reward = table.string("reward");
    table.reject_unknown();
    if (maze && !task.empty() && *maze != task)
        table.fail("maze", fmt::format("the world is maze:{} already", task), "Name one of both.");
    return std::make_unique<MazeWorld>(maze_plan(maze.value_or(task.empty() ? "medium" : task)),
                                       reward ? reward_names.choice(*reward, "a reward of a maze") : MazeReward::way);
}

}   // namespace

MazeWorld::MazeWorld(MazePlan const& plan, MazeReward reward)
    : RulesWorld(facts_of(plan), rules_of(plan, reward),
                 [] { return kernel_for(active_isa(), LORE_KERNELS(run_mazes)); }) {}

std::string MazeWorld::scene_svg() const {
    std::string scene = fmt::format(R"(<g><circle cx="{}" cy="{}" r="{}" fill="#2f9e6e"/>)", rules().goal_x,
                                    rules().goal_y, MazeRules::goal_radius);
    scene += R"(<g stroke="#3a3a3a" stroke-width="2">)";
    for (int w = 0; w < rules().wall_count; ++w) {
        MazeWall const& wall = rules().walls[w];
        scene += fmt::format(R"(<line x1="{}" y1="{}" x2="{}" y2="{}"/>)", wall.x0, wall.y0, wall.x1, wall.y1);
    }
    return scene + "</g></g>";
}

BuiltinWorld const maze_world{"maze", open_maze};

}   // namespace lore
