#include <lore/watch/watcher.h>

#include "curves.h"

#include <lore/campaign/replay_step.h>
#include <lore/campaign/time_left.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run_directory.h>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_failures = 50;   ///< shown with their logs

TreatmentFacts treatment_facts(CampaignPlan const& plan, std::string const& name, CampaignDirectory const& directory,
                               std::vector<StepWithState> const& steps, ProgressMemory& progress) {
    Treatment const& treatment = plan.treatment(name);
    TreatmentFacts facts;
    facts.name = name;
    facts.label = treatment.label;
    facts.is_source = plan.is_source(name);
    facts.target = treatment.target;
    if (!treatment.target.empty()) facts.target_label = plan.task(treatment.target).label;
    facts.planned = treatment.runs;
    std::vector<std::vector<double>> runs;
    for (auto const& [step, state] : steps) {
        if (step.kind != StepKind::evolve || step.subject != name) continue;
        facts.done += state.status == StepStatus::done;
        facts.running += state.status == StepStatus::running;
        facts.failed += state.status == StepStatus::failed;
        if (facts.reward_unit.empty()) facts.reward_unit = state.reward_unit;
        std::vector<double> const& rewards = progress.best_rewards(directory.run(step.name));
        if (rewards.empty()) continue;
        facts.best_reward = facts.started == 0 ? rewards.back() : std::max(facts.best_reward, rewards.back());
        ++facts.started;
        facts.mean_reward += rewards.back();
        runs.push_back(rewards);
    }
    if (facts.started > 0) facts.mean_reward /= facts.started;
    facts.curve = mean_curve(runs);
    return facts;
}

std::vector<FailureFacts> failures_among(std::vector<StepWithState> const& steps, CampaignDirectory const& directory) {
    std::vector<FailureFacts> failures;
    for (auto const& [step, state] : steps) {
        if (state.status != StepStatus::failed) continue;
        if (failures.size() == most_failures) break;
        auto const record = read_failure(directory, step);
        failures.push_back({step.name, state.reason, directory.log(step.name),
                            record ? record->log_tail : std::vector<std::string>{}});
    }
    return failures;
}

/// Fills what the facts say of all runs together.
void add_progress(CampaignFacts& facts) {
    std::vector<RunPace> paces;
    double reached = 0, planned = 0;
    int running = 0;
    for (auto const& [step, state] : facts.steps) {
        if (!is_run(step)) continue;
        bool const ended = state.status == StepStatus::done || state.status == StepStatus::failed;
        paces.push_back({step.group, state.generation, state.generations, state.seconds, !ended});
        reached += state.status == StepStatus::done ? state.generations : std::min(state.generation, state.generations);
        planned += state.generations;
        running += state.status == StepStatus::running;
    }
    facts.share = planned > 0 ? reached / planned : 0;
    double const left = work_left(paces);
    if (running > 0 && left > 0) facts.seconds_left = left / running;
}

/// The best finished run of these treatments; nothing if none is finished.
std::optional<Champion> champion_of(CampaignPlan const& plan, std::vector<std::string> const& treatments,
                                    CampaignFacts const& facts) {
    StepWithState const* const best = best_finished_run(facts.steps, treatments);
    if (best == nullptr) return std::nullopt;
    return Champion{best->step.name,
                    plan.treatment(best->step.subject).label,
                    best->state.best_reward,
                    best->state.reward_unit,
                    "",
                    ""};
}

}   // namespace

struct CampaignWatcher::Memory {
    /// A champion that was simulated, or could not be.
    struct Seen {
        Champion champion;
        std::optional<Replay> replay;
    };

    std::string file;
    CampaignDirectory directory;
    FileStamp file_stamp;
    CampaignPlan plan;
    ProgressMemory progress;
    std::vector<Seen> seen;
    CampaignFacts last;

    Memory(std::string of_file, std::string of_directory)
        : file(std::move(of_file)), directory(std::move(of_directory)), plan(read_campaign(file)) {
        file_stamp = stamp_of(plan.path);
    }

    void read_plan_again() {
        FileStamp const stamp = stamp_of(plan.path);
        if (stamp == file_stamp) return;
        plan = read_campaign(file);
        file_stamp = stamp;
    }

    Seen replayed(Champion champion) {
        try {
            champion.signature =
                read_manifest((fs::path{directory.run(champion.run)} / run_file::manifest).string()).signature;
            for (Seen const& known : seen)
                if (known.champion.run == champion.run && known.champion.signature == champion.signature) return known;
            Replay replay = replay_of(directory, champion.run);
            return {std::move(champion), std::move(replay)};
        } catch (std::exception const& error) {
            champion.problem = error.what();
            return {std::move(champion), std::nullopt};
        }
    }

    CampaignFacts facts() {
        read_plan_again();
        CampaignFacts now;
        now.title = plan.title;
        now.directory = directory.path();
        if (!fs::is_directory(directory.path()))
            now.notice = fmt::format("Waiting for {}: 'lore-campaign run' makes it.", directory.path());
        now.steps = states_of(plan, directory);
        for (std::string const& name : all_treatments(plan))
            now.treatments.push_back(treatment_facts(plan, name, directory, now.steps, progress));
        now.failures = failures_among(now.steps, directory);
        add_progress(now);
        std::vector<Seen> champions;
        std::vector<std::vector<std::string>> tasks;
        for (Treatment const& source : plan.sources) tasks.push_back({source.name});
        for (TaskGroup const& group : task_groups(plan)) tasks.push_back(group.treatments);
        for (auto const& names : tasks)
            if (auto champion = champion_of(plan, names, now)) champions.push_back(replayed(*std::move(champion)));
        seen = std::move(champions);
        for (Seen const& one : seen) now.champions.push_back(one.champion);
        return now;
    }
};

CampaignWatcher::CampaignWatcher(std::string file, std::string directory)
    : memory_(std::make_unique<Memory>(std::move(file), std::move(directory))) {}
CampaignWatcher::~CampaignWatcher() = default;

CampaignFacts CampaignWatcher::look() {
    CampaignFacts& last = memory_->last;
    try {
        last = memory_->facts();
    } catch (std::exception const& error) {
        last.title = memory_->plan.title;
        last.directory = memory_->directory.path();
        last.notice = error.what();
    }
    last.time = time_stamp();
    return last;
}

std::vector<Replay> CampaignWatcher::replays() const {
    std::vector<Replay> all;
    for (Memory::Seen const& one : memory_->seen)
        if (one.replay) all.push_back(*one.replay);
    return all;
}

}   // namespace lore
