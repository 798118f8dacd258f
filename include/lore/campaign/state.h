#pragma once

#include <lore/campaign/steps.h>
#include <lore/world/reward_text.h>

#include <optional>
#include <span>
#include <string>

namespace lore {

enum class StepStatus : std::uint8_t { done, running, interrupted, failed, missing };
std::string_view name(StepStatus);

/// How far a step has come, read from disk alone: nothing else is kept, so nothing can get out of step.
struct StepState {
    StepStatus status = StepStatus::missing;
    std::string reason;    ///< for people: "at generation 1200 of 4000", "exit code 1: ..."
    bool other = false;    ///< failed, since it is a finished run of another seed, of other settings or other inputs
    int generation = 0;    ///< of a run, as progress.csv says
    int generations = 0;   ///< that it is to reach
    double best_reward = 0;
    std::string reward_unit;   ///< of the run's world; "" as long as it is not known
    double seconds = 0;        ///< of wall time spent on it
};

/// A run is done when its manifest says so, and failed if it was made with other settings, another base or other
/// founders than planned; that of a target task is interrupted if more generations are planned now. A knowledge base is
/// done when its file is there, since lore-kb writes all or nothing. `locks`: the holder of the step's lock ignores
/// locks, because it would take itself for another process at work.
enum class Locks : std::uint8_t { looked_at, ignored };
StepState state_of(CampaignPlan const&, CampaignDirectory const&, Step const&, Locks locks = Locks::looked_at);

struct StepWithState {
    Step step;
    StepState state;
};
/// All steps of the campaign in their order; the reason of a missing one is what it waits for.
std::vector<StepWithState> states_of(CampaignPlan const&, CampaignDirectory const&);

/// The finished run of these treatments with most reward, the first among equals by their order; null if there is none.
StepWithState const* best_finished_run(std::span<StepWithState const>, std::span<std::string const> treatments);

/// The recorded choice from the runs of a source task, or nothing.
std::optional<Choice> recorded_choice(CampaignDirectory const&, std::string const& source);
/// Those of all source tasks together; nothing if there is none.
std::optional<Choice> recorded_choices(CampaignPlan const&, CampaignDirectory const&);

/// How the last attempt at a step failed; kept until the next succeeds.
struct FailureRecord {
    int attempts = 0;
    std::string how;                     ///< "exit code 1", "signal 9"
    std::vector<std::string> log_tail;   ///< last lines of its log
};
void write_failure(CampaignDirectory const&, Step const&, FailureRecord const&);
std::optional<FailureRecord> read_failure(CampaignDirectory const&, Step const&);
void clear_failure(CampaignDirectory const&, Step const&);

/// The last complete line of a run's progress.csv; all 0 if there is none.
struct RunProgress {
    int generation = 0;
    double best_reward = 0;
    double seconds = 0;
};
RunProgress last_progress(std::string const& run_directory);

}   // namespace lore
