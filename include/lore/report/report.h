#pragma once

#include <lore/campaign/steps.h>

#include <string>

namespace lore {

/// Writes a campaign's report into a directory, its own unless another is named (two campaigns that share their runs
/// would overwrite each other's): the CSV files, pvalues.csv, summary.json, figures/ and report.html.
///
/// Where the campaign's directory `from` has runs, the CSV files are made from them first; where it has none (results
/// kept without their runs), its CSV files are read as they are. What the campaign's step "replay" wrote (replay.csv,
/// values.csv, scene.json) is read from where the CSV files are read. All else is a function of the campaign's file and
/// these files: it holds no time, host or path, so the same results give the same bytes. Works over unfinished
/// campaigns.
///
/// Returns what the campaign's file asks for and these results cannot show, and what to do; "" if they show all.
/// Throws Error.
std::string write_report(CampaignPlan const&, CampaignDirectory const& from, CampaignDirectory const& into);
inline std::string write_report(CampaignPlan const& plan, CampaignDirectory const& directory) {
    return write_report(plan, directory, directory);
}

}   // namespace lore
