#pragma once

#include "comparison.h"
#include "html.h"
#include "matrix.h"
#include "results.h"

#include <string>
#include <vector>

namespace lore {

// The parts of report.html, each as HTML that ends with a line's end; "" where there is nothing to show.

std::string treatments_table(CampaignPlan const&, Results const&);
std::string populations_table(CampaignPlan const&, Results const&);
std::string speeds_table(CampaignPlan const&, Results const&, std::string_view id = "speeds");
std::string leads_table(CampaignPlan const&, Results const&);
std::string bases_table(CampaignPlan const&, Results const&);
std::string runs_table(CampaignPlan const&, Results const&);
/// `id` tells the page's tables apart.
std::string pairs_table(CampaignPlan const&, std::vector<Comparison> const&, std::string_view id = "pairs",
                        Spacing = Spacing::usual);
std::string matrix_table(CampaignPlan const&, std::vector<MatrixField> const&);
std::string pools_table(CampaignPlan const&, Results const&);
/// The appendix's square: every treatment against every other; "-" where two were not tested, since their rewards have
/// different units.
std::string p_value_square(CampaignPlan const&, std::vector<Comparison> const&);

/// The section with the robot to play, and the data that the page's script plays.
std::string replay_section(CampaignPlan const&, Results const&);

}   // namespace lore
