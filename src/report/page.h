#pragma once

#include "findings.h"
#include "results.h"

#include <map>
#include <string>
#include <vector>

namespace lore {

/// SVG documents by name: "figure3".
using Figures = std::map<std::string, std::string>;

/// What the campaign's file asks for and these results cannot show, and what to do; "" if they show all.
std::string what_is_missing(CampaignPlan const&, Results const&);

/// report.html: self-contained, opens offline.
std::string report_page(CampaignPlan const&, Results const&, Findings const&, Figures const&);

}   // namespace lore
