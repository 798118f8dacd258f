#pragma once

#include <lore/campaign/steps.h>

#include <string>
#include <vector>

namespace lore {

/// One sbatch script: a group of steps, as a job or as an array of tasks.
struct BatchJob {
    std::string group;    ///< of steps; "report" for the last
    std::string script;   ///< path
    std::string text;
    std::vector<int> tasks;               ///< runs of an array; empty: a single job
    std::vector<std::string> after;       ///< groups of this list whose jobs must have ended well
    std::vector<std::string> after_any;   ///< groups of this list whose jobs must have ended
};

/// Scripts for all that is not done yet, in the order of submission, the report last. Paths in them are absolute.
///
/// A task that stops at a checkpoint because its time is up queues itself again. The choice of source runs waits for
/// all of them to end, well or not; what is built from others waits for these to end well; the report waits for all.
std::vector<BatchJob> batch_jobs(CampaignPlan const&, CampaignDirectory const&, Launcher const&,
                                 std::string const& program);

/// Writes the scripts to DIR/slurm and hands them to sbatch, unless `only_write`. Job ids go to DIR/slurm/jobs.txt;
/// while any of those is still queued nothing is submitted again. Throws Error, with sbatch's own words.
std::vector<std::string> submit_campaign(CampaignPlan const&, CampaignDirectory const&, Launcher const&,
                                         std::string const& program, bool only_write);

}   // namespace lore
