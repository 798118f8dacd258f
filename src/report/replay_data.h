#pragma once

#include <lore/campaign/replay.h>

#include <nlohmann/json.hpp>

namespace lore {

/// What the page's script needs of a replay: replay.js of arena_view if `as_arena`, else world_replay.js. `panel`:
/// whose values color the path, or null.
nlohmann::ordered_json replay_data(Replay const&, PanelValues const* panel, bool as_arena);

}   // namespace lore
