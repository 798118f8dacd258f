#include <lore/campaign/runner.h>

#include "board.h"
#include "child.h"

#include <lore/campaign/choice.h>
#include <lore/campaign/state.h>
#include <lore/core/progress.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run_directory.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <poll.h>

namespace lore {

namespace {

constexpr int most_attempts = 2;

std::atomic<int> stop_requests{0};
void request_stop(int) { stop_requests.fetch_add(1); }
void wake_up(int) {}

/// Signals are let in only while we sleep, so that none is missed between a look and the sleep. Restores on leaving.
class SignalScope {
public:
    SignalScope() {
        stop_requests = 0;
        sigset_t ours;
        sigemptyset(&ours);
        for (int const signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGCHLD}) {
            sigaddset(&ours, signal);
            struct sigaction action {};
            action.sa_handler = signal == SIGCHLD ? wake_up : request_stop;
            ::sigaction(signal, &action, &former_[signal]);
        }
        ::sigprocmask(SIG_BLOCK, &ours, &former_mask_);
    }
    ~SignalScope() {
        for (auto const& [signal, action] : former_) ::sigaction(signal, &action, nullptr);
        ::sigprocmask(SIG_SETMASK, &former_mask_, nullptr);
    }
    void sleep(double seconds) const {
        timespec const time{static_cast<time_t>(seconds),
                            static_cast<long>((seconds - static_cast<double>(static_cast<time_t>(seconds))) * 1e9)};
        ::ppoll(nullptr, 0, &time, &former_mask_);
    }

private:
    std::map<int, struct sigaction> former_;
    sigset_t former_mask_{};
};

enum class Phase : std::uint8_t { waiting, working, elsewhere, done, failed, blocked };

struct Task {
    explicit Task(Step of) : step(std::move(of)) {}

    Step step;
    Phase phase = Phase::waiting;
    int attempts = 0;      ///< failed ones of this session
    int generation = 0;    ///< last seen
    int generations = 0;   ///< that it is to reach; 0 if it is no run
    int best_balls = 0;
    double seconds = 0;   ///< spent on it in all sessions
    int started_at = 0;   ///< generation at the last start: a resume that gains nothing counts as a failure
    pid_t pid = 0;
    std::optional<StepLock> lock;

    bool is_run() const { return step.kind == StepKind::evolve || step.kind == StepKind::archive; }
};

class Runner {
public:
    Runner(CampaignPlan const& plan, CampaignDirectory const& directory, RunnerOptions const& options)
        : plan_(plan), directory_(directory), options_(options), board_(options.quiet) {
        std::vector<Step> const all = steps_of(plan);
        for (Step const& step : options.only.empty() ? all : steps_named(all, options.only)) tasks_.emplace_back(step);
        for (Step const& step : all) steps_of_group_[step.group].push_back(step);
        for (Task& task : tasks_) settle_from_disk(task, true);
    }

    ExitCode run() {
        try {
            while (unfinished()) {
                reap();
                if (stop_requests > stops_passed_on_) pass_on_stop();
                if (stop_requests == 0) start_ready();
                else if (working() == 0) break;
                if (!unfinished()) break;
                show();
                signals_.sleep(board_.live() ? 0.5 : 1.0);
            }
        } catch (...) {
            // Our own trouble (a full disk, say) must not leave runs behind that nobody watches.
            for (Task const& task : tasks_)
                if (task.pid != 0) ::kill(task.pid, SIGUSR1);
            while (working() != 0) {
                signals_.sleep(1);
                for (Task& task : tasks_)
                    if (task.pid != 0 && poll_child(task.pid)) {
                        task.pid = 0;
                        task.phase = Phase::waiting;
                    }
            }
            throw;
        }
        return summary();
    }

private:
    int working() const { return count(Phase::working); }
    int count(Phase phase) const {
        return static_cast<int>(
            std::count_if(tasks_.begin(), tasks_.end(), [&](Task const& t) { return t.phase == phase; }));
    }
    bool unfinished() const { return count(Phase::waiting) + count(Phase::working) + count(Phase::elsewhere) > 0; }

    /// Takes over what the disk says. `fresh`: at the start, where an old failure is a reason to try again.
    void settle_from_disk(Task& task, bool fresh) {
        StepState const state = state_of(plan_, directory_, task.step, task.lock ? Locks::ignored : Locks::looked_at);
        if (task.is_run()) {
            task.generation = state.generation;
            task.generations = state.generations;
            task.best_balls = state.best_balls;
            task.seconds = state.seconds;
        }
        if (state.status == StepStatus::done) {
            task.phase = Phase::done;
            clear_failure(directory_, task.step);
        } else if (state.status == StepStatus::failed && fresh && !read_failure(directory_, task.step)) {
            // Not an attempt that failed but something that no attempt can mend, such as other settings.
            task.phase = Phase::failed;
            board_.complain(fmt::format("{} failed: {}", task.step.name, state.reason));
        } else {
            task.phase = Phase::waiting;
        }
    }

    /// What the task waits for: nothing, something that may still come, or something that will not.
    enum class Readiness : std::uint8_t { ready, later, never };
    Readiness readiness(Task const& task, std::string& missing) {
        for (std::string const& group : task.step.after) {
            bool const settled_is_enough = task.step.kind == StepKind::choose;   // it can do without runs that failed
            for (Step const& needed : steps_of_group_.at(group)) {
                auto const ours = std::find_if(tasks_.begin(), tasks_.end(),
                                               [&](Task const& t) { return t.step.name == needed.name; });
                if (ours == tasks_.end()) {
                    if (settled_is_enough || done_on_disk(needed)) continue;
                    missing = needed.name;
                    return Readiness::never;
                }
                if (ours->phase == Phase::done) continue;
                bool const lost = ours->phase == Phase::failed || ours->phase == Phase::blocked;
                if (lost && settled_is_enough) continue;
                if (lost) {
                    missing = needed.name;
                    return Readiness::never;
                }
                return Readiness::later;
            }
        }
        return Readiness::ready;
    }
    bool done_on_disk(Step const& step) {
        if (known_done_.contains(step.name)) return true;
        if (state_of(plan_, directory_, step).status != StepStatus::done) return false;
        known_done_.insert(step.name);
        return true;
    }

    void start_ready() {
        for (Task& task : tasks_) {
            if (working() >= options_.jobs) return;
            if (task.phase != Phase::waiting && task.phase != Phase::elsewhere) continue;
            std::string missing;
            Readiness const ready = readiness(task, missing);
            if (ready == Readiness::never) {
                task.phase = Phase::blocked;
                board_.complain(fmt::format("{} cannot be done: it waits for {}", task.step.name, missing));
            }
            if (ready == Readiness::ready) start(task);
        }
    }

    void start(Task& task) {
        task.lock = StepLock::take(directory_.lock(task.step.name));
        if (!task.lock) {
            task.phase = Phase::elsewhere;
            RunProgress const progress = last_progress(directory_.run(task.step.name));
            task.generation = progress.generation;
            return;
        }
        settle_from_disk(task, false);   // somebody else may have finished it while we waited for the lock
        if (task.phase == Phase::done) {
            task.lock.reset();
            board_.announce(fmt::format("{} done", task.step.name));
            return;
        }
        if (task.step.kind == StepKind::choose) {
            choose(task);
            return;
        }
        auto const choice = recorded_choice(directory_);
        auto const command = command_of(plan_, directory_, options_.launcher, task.step, choice ? &*choice : nullptr);
        std::string const parent =
            task.is_run() ? directory_.run(task.step.name) : directory_.knowledge(task.step.subject);
        std::filesystem::create_directories(std::filesystem::path{parent}.parent_path());
        task.started_at = task.generation;
        task.pid = start_child(command, directory_.log(task.step.name), task.lock->descriptor());
        task.phase = Phase::working;
        board_.announce(fmt::format(
            "{} {}", task.step.name,
            task.generation > 0 ? fmt::format("resumed at generation {} of {}", task.generation, task.generations)
                                : std::string{"started"}));
    }

    void choose(Task& task) {
        std::vector<SourceRun> finished;
        std::vector<int> without;
        for (Step const& step : steps_of_group_.at("source")) {
            StepState const state = state_of(plan_, directory_, step);
            if (state.status == StepStatus::done)
                finished.push_back({step.run, seed_of(plan_.source, step.run), state.best_balls});
            else without.push_back(step.run);
        }
        try {
            auto const before = recorded_choice(directory_);
            Choice const choice = choose_runs(plan_, finished, without, before ? *before : Choice{});
            std::filesystem::create_directories(std::filesystem::path{directory_.choice()}.parent_path());
            write_choice(directory_.choice(), choice);
            for (ChosenRun const& chosen : choice.chosen)
                board_.announce(fmt::format("{} comes from source run {} (seed {}, {} balls)", chosen.knowledge,
                                            chosen.run, chosen.seed, chosen.balls));
            task.phase = Phase::done;
        } catch (Error const& error) {
            task.phase = Phase::failed;
            board_.complain(fmt::format("{} failed: {}", task.step.name, error.what()));
        }
        task.lock.reset();
    }

    void reap() {
        for (Task& task : tasks_) {
            if (task.pid == 0) continue;
            if (task.is_run()) {
                RunProgress const progress = last_progress(directory_.run(task.step.name));
                task.generation = progress.generation;
                task.best_balls = progress.best_balls;
                task.seconds = progress.seconds;
            }
            auto const end = poll_child(task.pid);
            if (!end) continue;
            task.pid = 0;
            // Judged under our own lock: once given up it may seem taken for a moment, by a child that was just forked
            // with a copy of it.
            judge(task, *end);
            task.lock.reset();
        }
    }

    /// The disk decides whether the step is done: mpirun's exit code after a signal says little.
    void judge(Task& task, ChildEnd const& end) {
        settle_from_disk(task, false);
        if (task.phase == Phase::done) {
            board_.announce(fmt::format("{} done{}", task.step.name,
                                        task.is_run() ? fmt::format(", {} balls", task.best_balls) : ""));
            return;
        }
        if (stop_requests > 0) return;   // resumed next time
        bool const stopped_at_checkpoint = end.signal == 0 && end.exit_code == static_cast<int>(ExitCode::interrupted);
        if (stopped_at_checkpoint && task.generation > task.started_at) return;   // goes on at once
        ++task.attempts;
        auto const log = last_lines(directory_.log(task.step.name), 5);
        std::string how = text(end);
        if (end.signal == 0 && end.exit_code == 0) how = state_of(plan_, directory_, task.step, Locks::ignored).reason;
        if (how.empty()) how = "it ended without its result";
        // A command line or configuration that is refused will be refused again.
        bool const refused = end.signal == 0 && end.exit_code == static_cast<int>(ExitCode::usage);
        if (task.attempts < most_attempts && !refused) {
            board_.announce(fmt::format("{} failed ({}), trying once more", task.step.name, how));
            return;
        }
        task.phase = Phase::failed;
        write_failure(directory_, task.step, {task.attempts, how, log});
        board_.complain(fmt::format("{} failed{} ({}); {} ends with:", task.step.name,
                                    task.attempts > 1 ? " twice" : "", how, directory_.log(task.step.name)));
        for (std::string const& line : log) board_.complain("    " + line);
    }

    void pass_on_stop() {
        int const signal = stops_passed_on_ == 0 ? SIGUSR1 : SIGTERM;
        stops_passed_on_ = stop_requests;
        board_.announce(signal == SIGUSR1 ? "stopping at the next checkpoint; once more to stop at once"
                                          : "stopping at once");
        for (Task const& task : tasks_)
            if (task.pid != 0) ::kill(task.pid, task.is_run() ? signal : SIGTERM);
    }

    /// Seconds a generation of this treatment takes, from what its runs have shown, else from any; 0 if nobody knows.
    double seconds_per_generation(std::string const& group) const {
        double seconds = 0, generations = 0, all_seconds = 0, all_generations = 0;
        for (Task const& task : tasks_) {
            if (!task.is_run() || task.generation == 0) continue;
            all_seconds += task.seconds;
            all_generations += task.generation;
            if (task.step.group != group) continue;
            seconds += task.seconds;
            generations += task.generation;
        }
        if (generations > 0) return seconds / generations;
        return all_generations > 0 ? all_seconds / all_generations : 0;
    }

    std::string overall() const {
        double left = 0;
        std::map<std::string, double> cost;
        for (Task const& task : tasks_) {
            if (!task.is_run() || task.phase == Phase::done || task.phase == Phase::failed ||
                task.phase == Phase::blocked)
                continue;
            auto const known = cost.try_emplace(task.step.group, -1).first;
            if (known->second < 0) known->second = seconds_per_generation(task.step.group);
            left += known->second * (task.generations - task.generation);
        }
        left /= options_.jobs;
        double const done = count(Phase::done), all = static_cast<double>(tasks_.size());
        std::string const eta = left > 0 ? fmt::format(", about {} left", duration_text(left)) : "";
        return fmt::format("{} {} of {} steps done, {} running, {} failed{}", bar(done / all, 20), count(Phase::done),
                           tasks_.size(), working() + count(Phase::elsewhere),
                           count(Phase::failed) + count(Phase::blocked), eta);
    }

    void show() {
        if (!board_.live()) {
            auto const now = std::chrono::steady_clock::now();
            if (now - told_ < std::chrono::minutes{1}) return;
            told_ = now;
            board_.announce(overall());
            return;
        }
        std::vector<std::string> lines;
        for (Task const& task : tasks_) {
            if (task.phase != Phase::working) continue;
            if (!task.is_run() || task.generations == 0) {
                lines.push_back(fmt::format("  {:<22} at work", task.step.name));
                continue;
            }
            double const left =
                task.generation > 0 ? task.seconds / task.generation * (task.generations - task.generation) : 0;
            lines.push_back(fmt::format("  {:<22} {} {:>6}/{}  best {} {} {}", task.step.name,
                                        bar(static_cast<double>(task.generation) / task.generations, 20),
                                        task.generation, task.generations, task.best_balls,
                                        task.best_balls == 1 ? "ball " : "balls",
                                        left > 0 ? fmt::format(" {} left", duration_text(left)) : ""));
        }
        lines.push_back(overall());
        board_.draw(std::move(lines));
    }

    ExitCode summary() {
        int const failed = count(Phase::failed), blocked = count(Phase::blocked);
        bool const interrupted = unfinished();
        board_.announce(fmt::format("{} of {} steps done{}{}{}", count(Phase::done), tasks_.size(),
                                    failed > 0 ? fmt::format(", {} failed", failed) : "",
                                    blocked > 0 ? fmt::format(", {} wait for those", blocked) : "",
                                    interrupted ? "; run it again to go on" : ""));
        if (interrupted) return ExitCode::interrupted;
        return failed + blocked > 0 ? ExitCode::failure : ExitCode::done;
    }

    CampaignPlan const& plan_;
    CampaignDirectory const& directory_;
    RunnerOptions const& options_;
    SignalScope signals_;
    Board board_;
    std::vector<Task> tasks_;
    std::map<std::string, std::vector<Step>> steps_of_group_;
    std::set<std::string> known_done_;
    std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
    int stops_passed_on_ = 0;
};

}   // namespace

ExitCode run_campaign(CampaignPlan const& plan, CampaignDirectory const& directory, RunnerOptions const& options) {
    std::error_code failed;
    std::filesystem::create_directories(directory.path(), failed);
    if (!std::filesystem::is_directory(directory.path()))
        throw Error(fmt::format("cannot make the directory {}", directory.path()), failed.message(),
                    "Choose another with --dir.");
    return Runner{plan, directory, options}.run();
}

}   // namespace lore
