#pragma once

#include "child.h"
#include "task.h"

#include <lore/campaign/board.h>
#include <lore/campaign/runner.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lore {

/// Decides which step comes next, starts its program, and judges how it ended. Never waits; the caller waits between
/// its calls.
class Scheduler {
public:
    /// Throws UsageError if `options.only` names a step that does not exist. The references must outlive it.
    Scheduler(CampaignPlan const&, CampaignDirectory const&, RunnerOptions const&, Board&);

    std::vector<Task> const& tasks() const { return tasks_; }

    /// Starts what is ready, as long as fewer than `jobs` steps are worked on.
    void start_ready();
    /// Takes note of progress and of programs that have ended; kills launchers that outlive their ranks.
    void reap();
    /// Passes a request to stop on to all programs. `first`: runs go on to their next checkpoint; later: all end at
    /// once. From then on nothing that ends early counts as failed.
    void stop(bool first);
    /// Takes programs that have ended off the list, without judging them. For the way out after an error of our own.
    void forget_ended();

private:
    enum class Readiness : std::uint8_t { ready, later, never };
    /// Steps of one group, from the first to the last, that can never start, all because of the step `missing`.
    struct Blocked {
        Step const* first;
        Step const* last;
        std::string missing;
    };

    void settle_from_disk(Task&, bool fresh);
    Readiness readiness(Task const&, std::string& missing);
    Readiness readiness(Task const&, Step const& needed);
    bool done_on_disk(Step const&);
    void complain_of(Blocked const&);
    void start(Task&);
    void launch(Task&);
    void choose(Task&);
    void end_if_hanging(Task&);
    void judge(Task&, ChildEnd const&);
    void give_up(Task&, std::string const& how);

    CampaignPlan const& plan_;
    CampaignDirectory const& directory_;
    RunnerOptions const& options_;
    Board& board_;
    std::vector<Task> tasks_;
    std::map<std::string, std::vector<Step>> steps_of_group_;
    std::set<std::string> known_done_;   ///< steps that are none of our tasks
    bool stopping_ = false;
};

}   // namespace lore
