#pragma once

#include <lore/collectball/world.h>
#include <lore/episode/lanes.h>
#include <lore/world/open.h>
#include <lore/world/world.h>

#include <memory>
#include <string>

namespace lore {

/// An arena and its task as a World: sense, then act and move.
///
/// The reward is the number of balls that a step delivers; the outcome is where each ball was last released, x and y
/// in turn: the adhoc descriptor.
class CollectballWorld final : public LaneWorld {
public:
    /// `stop_when_still`: a life is over once more than so many steps in all went by without movement (position and
    /// heading changed by at most 1e-4); 0: never. The predecessor: 100.
    explicit CollectballWorld(Arena, int stop_when_still = 0);

    Arena const& arena() const { return arena_; }
    int stop_when_still() const { return stop_when_still_; }
    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override;
    void run_in_lanes(EpisodeConfig const&, int chunk_steps, LaneClient&) const override;
    std::string scene_svg() const override;

private:
    Arena arena_;
    int stop_when_still_;
    WorldFacts facts_;
};

/// The channels of every arena.
Channels const& collectball_channels();

/// Life::outcome of a world in this state: x and y of as many balls as fit.
void put_outcome(WorldState const&, std::span<float> values);

/// "collectball:TASK": a task of the built-in arena, `source` where none is named. It has no settings.
extern BuiltinWorld const collectball_world;

}   // namespace lore
