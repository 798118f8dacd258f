#include <lore/campaign/finished_runs.h>

#include <lore/campaign/state.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <filesystem>

namespace lore {

std::vector<FinishedRun> finished_runs(CampaignPlan const& plan, CampaignDirectory const& directory,
                                       Treatment const& treatment) {
    std::vector<FinishedRun> finished;
    for (int run = 1; run <= treatment.runs; ++run) {
        Step const step{run_step(treatment.name, run), StepKind::evolve, treatment.name, treatment.name, run, {}};
        if (state_of(plan, directory, step, Locks::ignored).status != StepStatus::done) continue;
        std::filesystem::path const path{directory.run(step.name)};
        finished.push_back({run, read_manifest((path / run_file::manifest).string()),
                            read_progress((path / run_file::progress).string())});
    }
    return finished;
}

}   // namespace lore
