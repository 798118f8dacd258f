#include <lore/collectball/replay.h>

#include "stillness.h"

namespace lore {

namespace {

StepRecord record(int step, Pose const& pose, Sensors const& sensors, Effectors const& effectors,
                  WorldState const& world, Pose const& next) {
    return {step,
            pose,
            sensors,
            effectors,
            world.carrying(),
            world.door_open,
            world.balls_mask,
            world.collected,
            world.switch_lit,
            world.switch_timer,
            next};
}

/// `sensors`: of robot and world as they are.
StepRecord step_by_hand(Arena const& arena, int step, Sensors const& sensors, Effectors const& effectors,
                        RobotState& robot, WorldState& world) {
    Pose const pose = robot.pose;
    act(arena, pose, effectors, world);
    move(arena, effectors, world, robot);
    return record(step, pose, sensors, effectors, world, robot.pose);
}

/// The world that a row describes. Which ball is carried is not recorded, and matters to no column.
WorldState world_after(Arena const& arena, StepRecord const& row) {
    WorldState world = start_world(arena);
    world.balls_mask = row.balls_mask;
    world.carried = row.carrying ? 0 : -1;
    world.door_open = row.door_open;
    world.switch_lit = row.switch_lit;
    world.switch_timer = static_cast<std::int16_t>(row.switch_timer);
    world.collected = row.collected;
    return world;
}

}   // namespace

std::vector<StepRecord> record_steps(CollectballWorld const& collectball, Network const& network,
                                     EpisodeConfig const& config) {
    Arena const& arena = collectball.arena();
    RobotState robot = start_robot(arena);
    WorldState world = start_world(arena);
    NetworkState state;
    int still_steps = 0;
    std::vector<StepRecord> rows;
    rows.reserve(static_cast<std::size_t>(config.steps));
    for (int step = 0; step < config.steps; ++step) {
        Effectors effectors;
        Sensors const sensors = sense(arena, robot, world);
        tick(network, sensors, state, effectors);
        rows.push_back(step_by_hand(arena, step, sensors, effectors, robot, world));
        if (collectball.stop_when_still() > 0 && is_still(rows.back().pose, robot.pose) &&
            ++still_steps > collectball.stop_when_still())
            break;
    }
    return rows;
}

std::vector<StepRecord> drive(Arena const& arena, std::span<Effectors const> actions) {
    RobotState robot = start_robot(arena);
    WorldState world = start_world(arena);
    std::vector<StepRecord> rows;
    rows.reserve(actions.size());
    for (Effectors const& effectors : actions)
        rows.push_back(
            step_by_hand(arena, static_cast<int>(rows.size()), sense(arena, robot, world), effectors, robot, world));
    return rows;
}

std::vector<StepRecord> follow(Arena const& arena, std::span<StepRecord const> recorded) {
    RobotState robot = start_robot(arena);
    WorldState world = start_world(arena);
    std::vector<StepRecord> rows;
    rows.reserve(recorded.size());
    for (StepRecord const& row : recorded) {
        robot.pose = row.pose;
        rows.push_back(step_by_hand(arena, row.step, sense(arena, robot, world), row.effectors, robot, world));
        world = world_after(arena, row);
    }
    return rows;
}

}   // namespace lore
