#pragma once

#include <lore/campaign/comparison.h>
#include <lore/campaign/results.h>

#include <map>
#include <string>

namespace lore {

/// Writes a campaign's report into a directory, its own unless another is named (two campaigns that share their runs
/// would overwrite each other's): the CSV files, pvalues.csv, summary.json, figures/ and report.html.
///
/// Where the campaign's directory `from` has runs, the CSV files are made from them first; where it has none (results
/// kept without their runs), its CSV files are read as they are. All else is a function of the campaign's file and the
/// CSV files: it holds no time, host or path, so the same results give the same bytes. Works over unfinished campaigns.
/// Throws Error.
void write_report(CampaignPlan const&, CampaignDirectory const& from, CampaignDirectory const& into);
inline void write_report(CampaignPlan const& plan, CampaignDirectory const& directory) {
    write_report(plan, directory, directory);
}

/// report.html: self-contained, opens offline. `figures`: SVG documents by name ("figure3").
std::string report_page(CampaignPlan const&, Results const&, std::vector<Comparison> const&,
                        std::map<std::string, std::string> const& figures);

}   // namespace lore
