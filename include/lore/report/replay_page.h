#pragma once

#include <lore/campaign/replay.h>

#include <string>
#include <vector>

namespace lore {

/// The replays as the script src/report/replay.js plays them, a JSON text: for pages other than the report's.
std::string replay_json(std::vector<Replay> const&);

}   // namespace lore
