#include <lore/campaign/state.h>

#include "treatment_inputs.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/file_lock.h>
#include <lore/campaign/choice.h>
#include <lore/campaign/replay_step.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>
#include <lore/core/names.h>
#include <lore/core/whole_number.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

namespace fs = std::filesystem;

std::string in(std::string const& directory, std::string_view name) { return (fs::path{directory} / name).string(); }

std::string text(FailureRecord const& failure) {
    return fmt::format("{} after {} attempt{}{}{}", failure.how, failure.attempts, failure.attempts == 1 ? "" : "s",
                       failure.log_tail.empty() ? "" : ": ", failure.log_tail.empty() ? "" : failure.log_tail.back());
}

/// A finished run of a target task of which the plan asks for more generations goes on; of a source task it does not,
/// because bases may have been built from it as it is.
bool goes_on(CampaignPlan const& plan, Treatment const& treatment, ExperimentConfig const& made, int generations) {
    return !plan.is_source(treatment.name) && generations > made.evolution.generations;
}

/// Settings of a finished run that differ from the plan and change its results; its length is one unless it goes on.
std::vector<SettingDifference> other_settings(CampaignPlan const& plan, Treatment const& treatment,
                                              ExperimentConfig made, bool longer) {
    ExperimentConfig planned = read_config(plan.config_path(treatment), treatment.overrides);
    // A knowledge base on the command line turns the objective on.
    planned.evolution.use_shaping = made.evolution.use_shaping = !treatment.knowledge.empty();
    auto differences = differing_settings(made, planned);
    std::erase_if(differences, [&](SettingDifference const& one) {
        return one.affects == Affects::nothing || (longer && one.affects == Affects::length);
    });
    return differences;
}

/// Of the run's world.
std::string unit_of(Manifest const& manifest) {
    std::string const& unit = manifest.world.reward_unit;
    return unit.empty() ? std::string{first_reward_unit} : unit;
}

StepState run_state(CampaignPlan const& plan, CampaignDirectory const& directory, Step const& step,
                    Treatment const& treatment, std::optional<std::uint64_t> seed, bool taken) {
    std::string const run = directory.run(step.name);
    StepState state;
    auto const row = read_last_progress(in(run, run_file::progress));
    if (row) {
        state.generation = row->generation;
        state.best_reward = row->best_reward;
        state.seconds = row->seconds;
    }
    ExperimentConfig const planned = read_config(plan.config_path(treatment), treatment.overrides);
    state.generations = planned.evolution.generations;
    if (!planned.has_world()) state.reward_unit = first_reward_unit;
    auto const say = [&](StepStatus status, std::string reason) {
        state.status = status;
        state.reason = std::move(reason);
        return state;
    };
    std::string const where = fmt::format("at generation {} of {}", state.generation, state.generations);

    // A finished run is done even if its lock is held: a child that was just forked holds all locks until it becomes
    // its program.
    std::optional<Manifest> manifest;
    std::optional<ExperimentConfig> config;   // of a finished run
    try {
        if (is_there(in(run, run_file::manifest))) manifest = read_manifest(in(run, run_file::manifest));
        if (manifest && manifest->status == RunStatus::done) config = read_config(in(run, run_file::config));
    } catch (Error const& error) { return say(StepStatus::failed, error.what()); }
    if (manifest) state.reward_unit = unit_of(*manifest);
    if (config) {
        auto const say_other = [&](std::string const& how) {
            state.other = true;
            return say(StepStatus::failed, fmt::format("it {}: move {} away", how, run));
        };
        if (seed && manifest->seed != *seed)
            return say_other(fmt::format("has seed {}, not {}", manifest->seed, *seed));
        bool const longer = goes_on(plan, treatment, *config, state.generations);
        if (auto const others = other_settings(plan, treatment, *config, longer); !others.empty())
            return say_other(fmt::format("was made with {}", text(others)));
        auto const choice = treatment.policy_of.empty() ? std::nullopt : recorded_choices(plan, directory);
        CommandContext const context{plan, directory, choice ? &*choice : nullptr};
        if (auto const others = other_inputs(treatment, context, planned.founders_from, *manifest); !others.empty())
            return say_other(fmt::format("was made {}", others));
        if (!is_there(in(run, run_file::lineage)))
            return say(StepStatus::failed, fmt::format("there is no {}", in(run, run_file::lineage)));
        if (!row || row->generation != manifest->generation)
            return say(StepStatus::failed,
                       fmt::format("its {} was cut, it ends at generation {} of {}: move {} away, or bring the whole "
                                   "file back",
                                   run_file::progress, state.generation, manifest->generation, run));
        if (!longer) return say(StepStatus::done, reward_text(state.best_reward, state.reward_unit));
    }
    if (taken) return say(StepStatus::running, where);
    if (auto const failure = read_failure(directory, step)) return say(StepStatus::failed, text(*failure));
    if (manifest) return say(StepStatus::interrupted, where);
    return say(StepStatus::missing, "");
}

/// Whether the outcome of a step that is no run is on disk, `choice` that of a step that chooses; if not, `reason` may
/// say why it is to be made again.
bool has_outcome(CampaignPlan const& plan, CampaignDirectory const& directory, Step const& step,
                 std::optional<Choice> const& choice, std::string& reason) {
    if (step.kind == StepKind::choose) return choice && choice->covers(plan);
    if (step.kind == StepKind::build) return is_there(directory.knowledge(step.subject));
    auto const due = replay_is_due(plan, directory, directory);
    if (due) reason = *due;
    return !due && can_replay(plan, directory);
}

}   // namespace

std::string_view name(StepStatus status) {
    constexpr auto names = names_for<StepStatus>("done", "running", "interrupted", "failed", "missing");
    return names[status];
}

std::optional<Choice> recorded_choice(CampaignDirectory const& directory, std::string const& source) {
    if (!is_there(directory.choice(source))) return std::nullopt;
    Choice choice = read_choice(directory.choice(source));
    choice.source = source;
    return choice;
}

std::optional<Choice> recorded_choices(CampaignPlan const& plan, CampaignDirectory const& directory) {
    std::optional<Choice> all;
    for (Treatment const& source : plan.sources) {
        auto const choice = recorded_choice(directory, source.name);
        if (!choice) continue;
        if (!all) all.emplace().source.clear();
        all->chosen.insert(all->chosen.end(), choice->chosen.begin(), choice->chosen.end());
    }
    return all;
}

StepState state_of(CampaignPlan const& plan, CampaignDirectory const& directory, Step const& step, Locks locks) {
    bool const taken = locks == Locks::looked_at && FileLock::is_taken(directory.lock(step.name));
    if (step.kind == StepKind::evolve) {
        Treatment const& treatment = plan.treatment(step.subject);
        return run_state(plan, directory, step, treatment, seed_of(treatment, step.run), taken);
    }
    if (step.kind == StepKind::archive) {
        KnowledgePlan const& base = plan.knowledge_base(plan.knowledge_base(step.subject).base);
        auto const choice = recorded_choice(directory, base.source);
        ChosenRun const* const origin = choice ? choice->find(base.name) : nullptr;
        StepState state = run_state(plan, directory, step, plan.treatment(base.source),
                                    origin ? std::optional{origin->seed} : std::nullopt, taken);
        if (state.status != StepStatus::done || origin == nullptr) return state;
        std::string const run = directory.run(step.name), source = directory.run(run_step(base.source, origin->run));
        auto const fail = [&](std::string reason) {
            state.status = StepStatus::failed;
            state.reason = std::move(reason);
        };
        try {
            std::string const original = in(source, run_file::manifest);   // not there while the source is made again
            if (!is_there(in(run, run_file::all_individuals)))
                fail(fmt::format("there is no {}", in(run, run_file::all_individuals)));
            else if (is_there(original) &&
                     read_manifest(in(run, run_file::manifest)).signature != read_manifest(original).signature)
                fail(fmt::format("its signature is not that of {}: was Lore changed between them?", source));
        } catch (Error const& error) { fail(error.what()); }
        return state;
    }
    StepState state;
    bool const chooses = step.kind == StepKind::choose;
    auto const choice = chooses ? recorded_choice(directory, step.subject) : std::nullopt;
    if (ChosenRun const* const old = choice ? choice->outdated(plan) : nullptr) {
        state.status = StepStatus::failed;
        state.reason =
            fmt::format("'{}' comes from run {}, which is not what the campaign asks for now: move {} and the "
                        "bases made from it away",
                        old->knowledge, old->run, directory.choice(step.subject));
        return state;
    }
    if (has_outcome(plan, directory, step, choice, state.reason)) {
        state.status = StepStatus::done;
        if (chooses) {
            std::vector<std::string> words;
            for (ChosenRun const& chosen : choice->chosen)
                words.push_back(fmt::format("{} from run {} ({})", chosen.knowledge, chosen.run,
                                            reward_text(chosen.reward, choice->reward_unit)));
            state.reason = fmt::format("{}", fmt::join(words, ", "));
        }
    } else if (taken) {
        state.status = StepStatus::running;
    } else if (auto const failure = read_failure(directory, step)) {
        state.status = StepStatus::failed;
        state.reason = text(*failure);
    }
    return state;
}

std::vector<StepWithState> states_of(CampaignPlan const& plan, CampaignDirectory const& directory) {
    std::vector<StepWithState> all;
    std::set<std::string> unfinished;   // groups; every step comes after those that it waits for
    for (Step const& step : steps_of(plan)) {
        StepState state = state_of(plan, directory, step);
        if (state.status != StepStatus::done) unfinished.insert(step.group);
        if (state.status == StepStatus::missing) {
            auto const open = std::find_if(step.after.begin(), step.after.end(),
                                           [&](std::string const& group) { return unfinished.contains(group); });
            if (open != step.after.end()) state.reason = fmt::format("waits for {}", *open);
            else if (state.reason.empty()) state.reason = "not started";
        }
        all.push_back({step, std::move(state)});
    }
    return all;
}

StepWithState const* best_finished_run(std::span<StepWithState const> steps, std::span<std::string const> treatments) {
    StepWithState const* best = nullptr;
    for (std::string const& treatment : treatments)
        for (StepWithState const& one : steps) {
            bool const finished = one.step.kind == StepKind::evolve && one.step.subject == treatment &&
                                  one.state.status == StepStatus::done;
            if (finished && (best == nullptr || one.state.best_reward > best->state.best_reward)) best = &one;
        }
    return best;
}

void write_failure(CampaignDirectory const& directory, Step const& step, FailureRecord const& failure) {
    nlohmann::ordered_json const document{
        {"attempts", failure.attempts}, {"how", failure.how}, {"log_tail", failure.log_tail}};
    // Logs may hold any bytes; what is no UTF-8 is replaced rather than refused.
    std::string const text = document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    write_file_atomically(directory.record(step.name), std::string_view{text});
}

std::optional<FailureRecord> read_failure(CampaignDirectory const& directory, Step const& step) {
    std::string const path = directory.record(step.name);
    if (!is_there(path)) return std::nullopt;
    std::string const text = read_text(path);
    try {
        auto const document = nlohmann::json::parse(text);
        return FailureRecord{whole_number<int>(document.at("attempts")), document.at("how"), document.at("log_tail")};
    } catch (std::exception const& error) {
        throw Error(fmt::format("cannot read {}", path), error.what(), "Remove it: the step is then tried again.");
    }
}

void clear_failure(CampaignDirectory const& directory, Step const& step) {
    std::error_code ignored;   // it may not be there
    fs::remove(directory.record(step.name), ignored);
}

RunProgress last_progress(std::string const& run_directory) {
    auto const row = read_last_progress(in(run_directory, run_file::progress));
    return row ? RunProgress{row->generation, row->best_reward, row->seconds} : RunProgress{};
}

}   // namespace lore
