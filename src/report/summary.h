#pragma once

#include "findings.h"
#include "results.h"

#include <string>

namespace lore {

/// summary.json: what each treatment reached and how they compare, for programs.
std::string summary_json(CampaignPlan const&, Results const&, Findings const&);

}   // namespace lore
