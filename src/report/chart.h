#pragma once

#include "comparison.h"
#include "results.h"

#include <string>
#include <vector>

namespace lore {

// Both figures show FigurePlan::figure3, without treatments and pools of other target tasks than the plan's order.

/// Figure 3: mean reward of the best-of-run by generation, a line a treatment with its confidence band, labeled at its
/// end. An SVG document. Treatments without runs are left out, and those of labels_of_other_units.
std::string draw_curves(CampaignPlan const&, Results const&);

/// Figure 4: a boxplot a target treatment at the last generation with every run as a point, and a bracket with the
/// paper's mark over each pair of them with p < 1e-2. Those of labels_of_other_units are left out.
std::string draw_boxplots(CampaignPlan const&, Results const&, std::vector<Comparison> const&);

/// How many source tasks figure 3 shows: those that have runs, and a reward of the unit of its axis.
std::size_t drawn_sources(CampaignPlan const&, Results const&);

/// Labels of the treatments and pools that neither figure can show on its axis: their rewards have another unit than
/// the results' first.
std::vector<std::string> labels_of_other_units(CampaignPlan const&, Results const&);

/// Color of the i-th target treatment: Okabe and Ito's palette (2008), told apart by color-blind readers.
std::string_view treatment_color(std::size_t i);

}   // namespace lore
