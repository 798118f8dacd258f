#pragma once

#include "results.h"

#include <string>
#include <string_view>

namespace lore {

/// Figure 5 or 6: the source run's trajectory, one panel for each of the figure's rows in values.csv. "" without any.
std::string draw_panels(CampaignPlan const&, Results const&, std::string_view figure);

/// What that figure shows, in words. Precondition: there are replays.
std::string panels_title(CampaignPlan const&, Results const&, std::string_view figure);

/// The labels of knowledge bases whose names are joined by '*', joined by a multiplication sign.
std::string knowledge_label(CampaignPlan const&, std::string_view names);

/// The document with `prefix` before every id and every reference to one, so that several can live in one page.
std::string with_own_ids(std::string svg, std::string_view prefix);

}   // namespace lore
