#pragma once

#include "inventory.h"

#include <lore/interchange/pack.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace lore {

using Json = nlohmann::ordered_json;

/// ro-crate-metadata.json: RO-Crate 1.2 with the runs as actions of Process Run Crate 0.5. A function of the files,
/// their contents and the options alone. Throws UsageError: a mistake in the options, no run; Error: a damaged run or
/// knowledge base.
std::string crate_json(CampaignPlan const&, CampaignDirectory const&, Inventory const&, PackOptions const&);

/// Where entities of the crate are found. Ids of files are relative URIs.
std::string entity_id(std::string_view path);
/// Of a file that is left out, and so no file of the crate.
std::string left_out_id(std::string_view path);
/// {"@id": id}
Json reference_to(std::string_view id);

/// What was done: entities of the actions, of what they were done with, and of the values that they took and gave.
struct CrateActions {
    std::vector<Json> entities;
    std::vector<std::string> ids;   ///< of the actions
    int runs = 0, finished = 0, bases = 0;
    std::string last_day;   ///< on which a run ended, YYYY-MM-DD; empty: none says so
};
/// `agents` are ids of those who ran it all.
CrateActions crate_actions(CampaignPlan const&, CampaignDirectory const&, Inventory const&,
                           std::vector<std::string> const& agents);

}   // namespace lore
