#pragma once

#include <lore/campaign/replay.h>

#include <string>
#include <vector>

namespace lore {

/// The replays as the scripts of the page play them (src/arena_view/replay.js, src/figure/world_replay.js), a JSON
/// text: for pages other than the report's.
std::string replay_json(std::vector<Replay> const&);

}   // namespace lore
