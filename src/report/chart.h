#pragma once

#include "comparison.h"
#include "results.h"

#include <string>

namespace lore {

/// Figure 3: mean best-of-run balls by generation, a line a treatment with its confidence band, labeled at its end.
/// An SVG document. Treatments without runs are left out.
std::string draw_curves(CampaignPlan const&, Results const&);

/// Figure 4: a boxplot a target treatment at the last generation with every run as a point, and a bracket with the
/// paper's mark over each pair with p < 1e-2.
std::string draw_boxplots(CampaignPlan const&, Results const&, std::vector<Comparison> const&);

/// Figure 5 or 6: the source run's trajectory, one panel for each of the figure's rows in values.csv. "" without any.
std::string draw_panels(CampaignPlan const&, Results const&, std::string_view figure);

/// The labels of knowledge bases whose names are joined by '*', joined by a multiplication sign.
std::string knowledge_label(CampaignPlan const&, std::string_view names);

/// The document with `prefix` before every id and every reference to one, so that several can live in one page.
std::string with_own_ids(std::string svg, std::string_view prefix);

/// Color of the i-th target treatment: Okabe and Ito's palette (2008), told apart by color-blind readers.
std::string_view treatment_color(std::size_t i);

}   // namespace lore
