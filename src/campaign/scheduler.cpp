#include "scheduler.h"

#include "view.h"

#include <lore/campaign/choice.h>
#include <lore/campaign/state.h>
#include <lore/core/file.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr int most_attempts = 2;

}   // namespace

Scheduler::Scheduler(CampaignPlan const& plan, CampaignDirectory const& directory, RunnerOptions const& options,
                     Board& board)
    : plan_(plan), directory_(directory), options_(options), board_(board) {
    std::vector<Step> const all = steps_of(plan);
    for (Step const& step : options.only.empty() ? all : steps_named(all, options.only)) tasks_.emplace_back(step);
    for (Step const& step : all) steps_of_group_[step.group].push_back(step);
    for (Task& task : tasks_) settle_from_disk(task, true);
}

/// Takes over what the disk says. `fresh`: at the start, where an old failure is a reason to try again.
void Scheduler::settle_from_disk(Task& task, bool fresh) {
    StepState const state = state_of(plan_, directory_, task.step, task.lock ? Locks::ignored : Locks::looked_at);
    if (is_run(task.step)) {
        task.generation = state.generation;
        task.generations = state.generations;
        task.best_reward = state.best_reward;
        task.reward_unit = state.reward_unit;
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

/// Whether the task can start: now, later, or never, because of the step `missing`.
Scheduler::Readiness Scheduler::readiness(Task const& task, std::string& missing) {
    for (std::string const& group : task.step.after)
        for (Step const& needed : steps_of_group_.at(group)) {
            Readiness const ready = readiness(task, needed);
            if (ready == Readiness::never) missing = needed.name;
            if (ready != Readiness::ready) return ready;
        }
    return Readiness::ready;
}

/// The same as far as one of the steps that it waits for is concerned.
Scheduler::Readiness Scheduler::readiness(Task const& task, Step const& needed) {
    // Runs that failed are done without, but pictures show runs that were chosen.
    bool const can_do_without = task.step.takes_what_is_there && needed.kind != StepKind::choose;
    auto const ours =
        std::find_if(tasks_.begin(), tasks_.end(), [&](Task const& t) { return t.step.name == needed.name; });
    if (ours == tasks_.end()) {
        if (done_on_disk(needed)) return Readiness::ready;
        // What is chosen stays chosen: not before every source run has ended, wherever it runs.
        bool const ended =
            task.step.kind != StepKind::choose || state_of(plan_, directory_, needed).status == StepStatus::failed;
        return can_do_without && ended ? Readiness::ready : Readiness::never;
    }
    if (ours->phase == Phase::done) return Readiness::ready;
    if (ours->phase == Phase::failed || ours->phase == Phase::blocked)
        return can_do_without ? Readiness::ready : Readiness::never;
    return Readiness::later;
}

bool Scheduler::done_on_disk(Step const& step) {
    if (known_done_.contains(step.name)) return true;
    if (state_of(plan_, directory_, step).status != StepStatus::done) return false;
    known_done_.insert(step.name);
    return true;
}

void Scheduler::start_ready() {
    std::vector<Blocked> blocked;
    for (Task& task : tasks_) {
        if (count(tasks_, Phase::working) >= options_.jobs) break;
        if (task.phase != Phase::waiting && task.phase != Phase::elsewhere) continue;
        std::string missing;
        Readiness const ready = readiness(task, missing);
        if (ready == Readiness::never) {
            task.phase = Phase::blocked;
            if (blocked.empty() || blocked.back().first->group != task.step.group || blocked.back().missing != missing)
                blocked.push_back({&task.step, &task.step, missing});
            blocked.back().last = &task.step;
        }
        if (ready == Readiness::ready) start(task);
    }
    for (Blocked const& steps : blocked) complain_of(steps);
}

/// One line for all runs of a treatment: there may be hundreds.
void Scheduler::complain_of(Blocked const& steps) {
    bool const one = steps.first == steps.last;
    bool const ours =
        std::any_of(tasks_.begin(), tasks_.end(), [&](Task const& task) { return task.step.name == steps.missing; });
    board_.complain(fmt::format("{}{} cannot be done: {} for {}{}", steps.first->name,
                                one ? "" : " to " + steps.last->name, one ? "it waits" : "they wait", steps.missing,
                                ours ? "" : ", which is not done and not among the steps named by --only"));
}

void Scheduler::start(Task& task) {
    task.lock = FileLock::take(directory_.lock(task.step.name));
    if (!task.lock) {
        task.phase = Phase::elsewhere;
        task.generation = last_progress(directory_.run(task.step.name)).generation;
        return;
    }
    settle_from_disk(task, false);   // another process may have finished it while we waited for the lock
    if (task.phase == Phase::done) {
        task.lock.reset();
        board_.announce(fmt::format("{} done", task.step.name));
        return;
    }
    if (task.step.kind == StepKind::choose) choose(task);
    else launch(task);
}

/// Starts the program of a task whose lock is ours.
void Scheduler::launch(Task& task) {
    auto const choice = recorded_choices(plan_, directory_);
    auto const command = command_of(plan_, directory_, options_.launcher, task.step, choice ? &*choice : nullptr);
    std::string const product =
        is_run(task.step) ? directory_.run(task.step.name) : directory_.knowledge(task.step.subject);
    make_directory(std::filesystem::path{product}.parent_path().string());
    task.started_at = task.generation;
    task.pid = start_child(command, directory_.log(task.step.name), task.lock->descriptor());
    task.phase = Phase::working;
    task.watch.reset();
    if (is_run(task.step) && options_.launcher.ranks > 1)
        task.watch.emplace(std::chrono::duration<double>{options_.launcher_patience});
    board_.announce(started_line(task));
}

void Scheduler::choose(Task& task) {
    std::vector<SourceRun> finished;
    std::vector<int> without;
    std::string unit{first_reward_unit};
    Treatment const& source = plan_.treatment(task.step.subject);
    for (Step const& step : steps_of_group_.at(source.name)) {
        StepState const state = state_of(plan_, directory_, step);
        if (state.status != StepStatus::done) {
            without.push_back(step.run);
            continue;
        }
        finished.push_back({step.run, seed_of(source, step.run), state.best_reward});
        unit = state.reward_unit;
    }
    try {
        auto const before = recorded_choice(directory_, source.name);
        if (before && before->outdated(plan_) != nullptr)
            throw Error("the source runs cannot be chosen",
                        state_of(plan_, directory_, task.step, Locks::ignored).reason, "Then run the campaign again.");
        Choice none_yet;
        none_yet.source = source.name;
        Choice choice = choose_runs(plan_, finished, without, before.value_or(none_yet));
        choice.reward_unit = unit;
        std::string const path = directory_.choice(source.name);
        make_directory(std::filesystem::path{path}.parent_path().string());
        write_choice(path, choice);
        for (ChosenRun const& chosen : choice.chosen)
            board_.announce(fmt::format("{} comes from {} run {} (seed {}, {})", chosen.knowledge, source.name,
                                        chosen.run, chosen.seed, reward_text(chosen.reward, unit)));
        task.phase = Phase::done;
        clear_failure(directory_, task.step);
    } catch (Error const& error) {
        task.phase = Phase::failed;
        write_failure(directory_, task.step, {1, error.what(), {}});
        board_.complain(fmt::format("{} failed: {}", task.step.name, error.what()));
    }
    task.lock.reset();
}

void Scheduler::reap() {
    for (Task& task : tasks_) {
        if (task.pid == 0) continue;
        if (is_run(task.step)) {
            RunProgress const progress = last_progress(directory_.run(task.step.name));
            task.generation = progress.generation;
            task.started_at = std::min(task.started_at, task.generation);   // a killed run goes on from its checkpoint
            task.best_reward = progress.best_reward;
            task.seconds = progress.seconds;
        }
        end_if_hanging(task);
        auto const end = poll_child(task.pid);
        if (!end) continue;
        task.pid = 0;
        // Judged under our own lock: once given up it may seem taken for a moment, by a child that was just forked
        // with a copy of it.
        judge(task, *end);
        task.lock.reset();
    }
}

void Scheduler::end_if_hanging(Task& task) {
    if (!task.watch || !task.watch->hangs(ranks_of(task.pid, "lore-evolve"), LauncherWatch::Clock::now())) return;
    task.watch.reset();   // once is enough
    std::string const what =
        fmt::format("its launcher has had no living rank for {} s, and was killed", options_.launcher_patience);
    append_to_log(directory_.log(task.step.name), fmt::format("lore-campaign: {}", what));
    board_.announce(fmt::format("{}: {}", task.step.name, what));
    ::kill(-task.pid, SIGKILL);   // it leads a process group of its own
}

/// The disk decides whether the step is done: mpirun's exit code after a signal says little.
void Scheduler::judge(Task& task, ChildEnd const& end) {
    settle_from_disk(task, false);
    if (task.phase == Phase::done) {
        board_.announce(fmt::format("{} done{}", task.step.name,
                                    is_run(task.step) ? ", " + reward_text(task.best_reward, task.reward_unit) : ""));
        return;
    }
    if (stopping_) return;   // resumed next time
    bool const stopped_at_checkpoint = end.signal == 0 && end.exit_code == static_cast<int>(ExitCode::interrupted);
    if (stopped_at_checkpoint && task.generation > task.started_at) return;   // goes on at once
    ++task.attempts;
    std::string how = text(end);
    if (end.signal == 0 && end.exit_code == 0) how = state_of(plan_, directory_, task.step, Locks::ignored).reason;
    if (how.empty()) how = "it ended without its result";
    // A command line or configuration that is refused will be refused again.
    bool const refused = end.signal == 0 && end.exit_code == static_cast<int>(ExitCode::usage);
    if (task.attempts < most_attempts && !refused)
        board_.announce(fmt::format("{} failed ({}), trying once more", task.step.name, how));
    else give_up(task, how);
}

void Scheduler::give_up(Task& task, std::string const& how) {
    auto const log = last_lines(directory_.log(task.step.name), 5);
    task.phase = Phase::failed;
    write_failure(directory_, task.step, {task.attempts, how, log});
    board_.complain(fmt::format("{} failed{} ({}); {} ends with:", task.step.name, task.attempts > 1 ? " twice" : "",
                                how, directory_.log(task.step.name)));
    for (std::string const& line : log) board_.complain("    " + line);
}

void Scheduler::stop(bool first) {
    stopping_ = true;
    for (Task const& task : tasks_)
        if (task.pid != 0) ::kill(task.pid, first && is_run(task.step) ? SIGUSR1 : SIGTERM);
}

void Scheduler::forget_ended() {
    for (Task& task : tasks_) {
        if (task.pid == 0) continue;
        end_if_hanging(task);
        if (!poll_child(task.pid)) continue;
        task.pid = 0;
        task.phase = Phase::waiting;
    }
}

}   // namespace lore
