#pragma once

#include <lore/campaign/steps.h>

#include <string>

namespace lore {

/// What was exported.
struct ExportCounts {
    int treatments = 0, runs = 0;
};

/// Writes a campaign's finished runs in the format of IOHprofiler, for IOHanalyzer and iohinspector
/// (docs/manual/formats.md, "IOHprofiler"): `out`, a new directory, with a folder for each treatment.
///
/// A treatment is an algorithm, a run an instance, the reward of the best controller so far a maximized objective over
/// evaluations; what differs in world, task or episode is another function. All or nothing: a directory that is not
/// whole never has the name `out`. Throws UsageError: `out` exists, or no run is finished; Error: a damaged run.
ExportCounts export_iohprofiler(CampaignPlan const&, CampaignDirectory const&, std::string const& out);

}   // namespace lore
