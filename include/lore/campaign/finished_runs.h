#pragma once

#include <lore/campaign/steps.h>
#include <lore/evolution/summary.h>
#include <lore/experiment/manifest.h>

#include <vector>

namespace lore {

/// A finished run of a treatment, as its files have it.
struct FinishedRun {
    int number = 0;   ///< among the treatment's runs, from 1
    Manifest manifest;
    std::vector<GenerationSummary> progress;   ///< by generation, from 0; at least one
};

/// By their numbers. Throws Error for a damaged file, and for one without a generation.
std::vector<FinishedRun> finished_runs(CampaignPlan const&, CampaignDirectory const&, Treatment const&);

}   // namespace lore
