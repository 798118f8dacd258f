#pragma once

#include <lore/arena_view/scene.h>

#include <span>
#include <string>
#include <vector>

namespace lore {

/// Where the robot heads and what has happened in the arena at the beginning of a step.
struct ArenaStep {
    float theta = 0;   ///< [rad]
    bool carrying = false, door_open = false, switch_on = false;
    unsigned balls_mask = 0;   ///< bit i: ball i lies on the floor
    int collected = 0;
};

/// What an arena shows along an evaluation besides positions.
struct ArenaReplay {
    ArenaScene scene;
    std::vector<ArenaStep> steps;
};

/// The arena and its changes as replay.js of this module plays them, JSON texts.
std::string page_arena(ArenaScene const&);
/// [step, carrying, door open, lamp lit, balls on the floor, collected], one at each change.
std::string page_events(std::span<ArenaStep const>);

}   // namespace lore
