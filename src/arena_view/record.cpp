#include <lore/arena_view/record.h>

namespace lore {

std::shared_ptr<CollectballWorld const> arena_world(std::shared_ptr<World const> const& world) {
    return std::dynamic_pointer_cast<CollectballWorld const>(world);
}

ArenaReplay arena_replay(Arena const& arena, std::vector<StepRecord> const& steps) {
    ArenaReplay replay{scene_of(arena), {}};
    WorldState const start = start_world(arena);
    // A record tells of the world after its step's action, a replay of the world before it.
    ArenaStep now{0, start.carrying(), start.door_open, start.switch_lit, start.balls_mask, start.collected};
    for (StepRecord const& step : steps) {
        now.theta = step.pose.theta;
        replay.steps.push_back(now);
        now = {0, step.carrying, step.door_open, step.switch_lit, step.balls_mask, step.collected};
    }
    return replay;
}

}   // namespace lore
