#pragma once

#include <lore/campaign/replay.h>

#include <nlohmann/json.hpp>

namespace lore {

/// What replay.js needs of a replay; `panel`: whose values color the path, or null.
nlohmann::ordered_json replay_data(Replay const&, PanelValues const* panel);

}   // namespace lore
