#include <lore/campaign/runner.h>

#include "scheduler.h"
#include "view.h"

#include <lore/campaign/board.h>
#include <lore/campaign/stop_signals.h>
#include <lore/core/file.h>

#include <chrono>
#include <cstdlib>

namespace lore {

namespace {

/// Shows how far the campaign is: always on a terminal, otherwise once a minute.
class Display {
public:
    explicit Display(Board& board) : board_(board) {}

    void show(std::vector<Task> const& tasks, int jobs) {
        if (board_.live()) {
            std::vector<std::string> lines = step_lines(tasks);
            lines.push_back(overall_line(tasks, jobs));
            board_.draw(std::move(lines));
            return;
        }
        auto const now = std::chrono::steady_clock::now();
        if (now - told_ < std::chrono::minutes{1}) return;
        told_ = now;
        board_.announce(overall_line(tasks, jobs));
    }

private:
    Board& board_;
    std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
};

/// Passes each new request to stop on; `passed_on` counts them.
void pass_on_stops(int requests, int& passed_on, Scheduler& scheduler, Board& board) {
    if (requests == passed_on) return;
    bool const first = passed_on == 0;
    passed_on = requests;
    board.announce(first ? "stopping at the next checkpoint; once more to stop at once" : "stopping at once");
    scheduler.stop(first);
}

void work_through(Scheduler& scheduler, StopSignals const& signals, Board& board, int jobs) {
    Display display{board};
    int stops_passed_on = 0;
    while (unfinished(scheduler.tasks()) > 0) {
        scheduler.reap();
        pass_on_stops(signals.requests(), stops_passed_on, scheduler, board);
        if (signals.requests() == 0) scheduler.start_ready();
        else if (count(scheduler.tasks(), Phase::working) == 0) break;
        if (unfinished(scheduler.tasks()) == 0) break;
        display.show(scheduler.tasks(), jobs);
        signals.sleep(board.live() ? 0.5 : 1.0);
    }
}

/// Lets no program outlive an error of our own (a full disk, say), since then no process would watch it.
void wind_up(Scheduler& scheduler, StopSignals const& signals) {
    int heard = signals.requests();
    if (heard == 0) scheduler.stop(true);   // else they have been told; a second time would end them at once
    while (count(scheduler.tasks(), Phase::working) > 0) {
        signals.sleep(1);
        if (signals.requests() != heard) scheduler.stop(false);
        heard = signals.requests();
        scheduler.forget_ended();
    }
}

ExitCode outcome(std::vector<Task> const& tasks) {
    if (unfinished(tasks) > 0) return ExitCode::interrupted;
    bool const lost = count(tasks, Phase::failed) + count(tasks, Phase::blocked) > 0;
    return lost ? ExitCode::failure : ExitCode::done;
}

}   // namespace

ExitCode run_campaign(CampaignPlan const& plan, CampaignDirectory const& directory, RunnerOptions const& options) {
    make_directory(directory.path());
    // In an allocation of several tasks a run of one rank is no launch that went wrong, though it is alone.
    if (options.launcher.ranks == 1)
        for (char const* const tasks : {"SLURM_NTASKS", "SLURM_STEP_NUM_TASKS"}) ::unsetenv(tasks);
    StopSignals const signals;
    Board board{options.quiet};
    Scheduler scheduler{plan, directory, options, board};
    try {
        work_through(scheduler, signals, board, options.jobs);
    } catch (...) {
        wind_up(scheduler, signals);
        throw;
    }
    board.announce(summary_line(scheduler.tasks()));
    return outcome(scheduler.tasks());
}

}   // namespace lore
