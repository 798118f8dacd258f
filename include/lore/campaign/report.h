#pragma once

#include <lore/campaign/comparison.h>
#include <lore/campaign/results.h>

#include <map>
#include <string>

namespace lore {

/// Writes a campaign's report into its directory: the CSV files, pvalues.csv, summary.json, figures/ and report.html.
///
/// Where the directory has runs, the CSV files are made from them first; where it has none (results kept without their
/// runs), they are taken as they are. All else is a function of the campaign's file and the CSV files: it holds no
/// time, host or path, so the same results give the same bytes. Works over unfinished campaigns. Throws Error.
void write_report(CampaignPlan const&, CampaignDirectory const&);

/// report.html: self-contained, opens offline. `figures`: SVG documents by name ("figure3").
std::string report_page(CampaignPlan const&, Results const&, std::vector<Comparison> const&,
                        std::map<std::string, std::string> const& figures);

} // namespace lore
