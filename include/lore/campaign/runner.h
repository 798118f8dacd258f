#pragma once

#include <lore/campaign/steps.h>
#include <lore/core/error.h>

namespace lore {

struct RunnerOptions {
    Launcher launcher;
    int jobs = 1;                    ///< steps at a time
    std::vector<std::string> only;   ///< steps or groups to work on; empty: all
    bool quiet = false;
    double launcher_patience = 10;   ///< a launcher without a living rank is killed after that time [s]
};

/// Works through a campaign on this machine until all is done, has failed twice, or a signal asks to stop.
///
/// A step is started when what it waits for is done; finished ones are skipped, interrupted ones resumed, failed ones
/// tried twice while the others go on. Steps that another process works on are waited for. INT, TERM, HUP, USR1 and
/// USR2 are passed on once, as USR1, so that the runs stop at a checkpoint; a second one ends them at once. A launcher
/// (mpirun) that outlives its ranks is killed: its step is then done or has failed, as the disk says.
///
/// Returns done, failure (some step failed, or waits for one that did) or interrupted. Every failure has been said on
/// stderr by then, with the last lines of its log.
ExitCode run_campaign(CampaignPlan const&, CampaignDirectory const&, RunnerOptions const&);

}   // namespace lore
