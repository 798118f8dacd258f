#pragma once

#include <lore/collectball/collectball.h>

#include <span>
#include <vector>

namespace lore {

/// One step of an evaluation with all there is to know: a row of trace.csv (docs/manual/formats.md).
struct StepRecord {
    int step = 0;
    Pose pose;   ///< when the sensors are read
    Sensors sensors{};
    Effectors effectors{};
    // The world after the action of this step:
    bool carrying = false;
    bool door_open = false;
    std::uint16_t balls_mask = 0;   ///< bit i: ball i lies on the floor
    int collected = 0;
    bool switch_lit = true;
    int switch_timer = 0;
    Pose next;   ///< after the move
    friend bool operator==(StepRecord const&, StepRecord const&) = default;
};

/// A controller's evaluation.
std::vector<StepRecord> record_steps(CollectballWorld const&, Network const&, EpisodeConfig const&);

/// Open loop: the robot does what `actions` say, from the start.
std::vector<StepRecord> drive(Arena const&, std::span<Effectors const> actions);

/// Teacher forcing: for each recorded row, starts from its pose and from the world after the row above, senses, does
/// the recorded action and moves. Bumpers are those of this simulation's own move in the row above. The result can be
/// compared with the record row by row, because errors do not add up.
std::vector<StepRecord> follow(Arena const&, std::span<StepRecord const> recorded);

}   // namespace lore
