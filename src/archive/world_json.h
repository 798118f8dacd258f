#pragma once

#include <lore/archive/world_record.h>

#include <nlohmann/json.hpp>

namespace lore {

nlohmann::ordered_json json_of(WorldRecord const&);
/// Throws nlohmann's exceptions, or std::out_of_range with the reason.
WorldRecord world_record_of(nlohmann::ordered_json const&);

}   // namespace lore
