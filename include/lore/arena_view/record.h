#pragma once

#include <lore/arena_view/replay.h>
#include <lore/collectball/replay.h>
#include <lore/world/world.h>

#include <memory>
#include <vector>

namespace lore {

/// Null where the world is another than an arena.
std::shared_ptr<CollectballWorld const> arena_world(std::shared_ptr<World const> const&);

/// What was recorded, as replays show it.
ArenaReplay arena_replay(Arena const&, std::vector<StepRecord> const&);

}   // namespace lore
