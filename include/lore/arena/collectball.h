#pragma once

#include <lore/arena/world.h>
#include <lore/world/open.h>
#include <lore/world/world.h>

#include <memory>
#include <string>

namespace lore {

/// An arena and its task as a World: sense, then act and move, as an episode does (episode/episode.h), to the bit.
///
/// The reward is the number of balls that a step delivers; the outcome is where each ball was last released, x and y
/// in turn: the adhoc descriptor. No life is ever over.
class CollectballWorld final : public World {
public:
    explicit CollectballWorld(Arena);

    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override;
    std::string scene_svg() const override;

private:
    Arena arena_;
    WorldFacts facts_;
};

/// "collectball:TASK": a task of the built-in arena, `source` where none is named. It has no settings.
extern BuiltinWorld const collectball_world;

}   // namespace lore
