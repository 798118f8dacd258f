#pragma once

#include "findings.h"
#include "results.h"

#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// summary.json: what each treatment reached and how they compare, for programs.
std::string summary_json(CampaignPlan const&, Results const&, Findings const&);
/// Names of the target tasks in such a document, one a treatment; none where it is none.
std::vector<std::string> tasks_in_summary(std::string_view text);

}   // namespace lore
