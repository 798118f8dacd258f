#include "results.h"

#include <lore/archive/knowledge_file.h>
#include <lore/campaign/choice.h>
#include <lore/campaign/finished_runs.h>
#include <lore/campaign/state.h>
#include <lore/core/file.h>
#include <lore/core/whole_number.h>
#include <lore/statistics/bootstrap.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

/// Curves are kept at so many generations at most: what a figure can show.
constexpr int most_curve_points = 401;

/// The runs of a treatment or a pool as curves of the best reward, from generation 0.
struct RewardCurves {
    std::string name;
    std::vector<std::vector<double>> curves;
};

/// Generations that all of the runs have reached.
int common_length(std::vector<FinishedRun> const& runs) {
    auto const shortest = std::min_element(runs.begin(), runs.end(), [](FinishedRun const& a, FinishedRun const& b) {
        return a.progress.size() < b.progress.size();
    });
    return static_cast<int>(shortest->progress.size());
}

RunRow row_of(Treatment const& treatment, FinishedRun const& run) {
    Manifest const& manifest = run.manifest;
    return {treatment.name,
            run.number,
            manifest.seed,
            run.progress.back().best_reward,
            run.progress.back().generation,
            run.progress.back().evaluations,
            manifest.signature,
            fmt::format("{} ({})", manifest.build.version, manifest.build.commit),
            manifest.world.reward_unit.empty() ? std::string{first_reward_unit} : manifest.world.reward_unit};
}

std::size_t common_length(RewardCurves const& runs) {
    std::size_t length = runs.curves.front().size();
    for (std::vector<double> const& curve : runs.curves) length = std::min(length, curve.size());
    return length;
}

std::vector<CurveRow> curve_of(RewardCurves const& runs) {
    std::size_t const length = common_length(runs);
    std::size_t const stride = std::max<std::size_t>(1, (length - 1 + most_curve_points - 2) / (most_curve_points - 1));
    std::vector<std::size_t> generations;
    for (std::size_t g = 0; g < length; g += stride) generations.push_back(g);
    if (generations.back() != length - 1) generations.push_back(length - 1);

    std::vector<std::vector<double>> curves;
    for (std::vector<double> const& rewards : runs.curves) {
        curves.emplace_back();
        for (std::size_t const g : generations) curves.back().push_back(rewards[g]);
    }
    MeanBand const band = bootstrap_mean_band(curves);
    std::vector<CurveRow> rows;
    for (std::size_t c = 0; c < generations.size(); ++c)
        rows.push_back({runs.name, static_cast<int>(generations[c]), static_cast<int>(curves.size()), band.mean[c],
                        band.low[c], band.high[c]});
    return rows;
}

/// 0, 1, 2, 5, 10, 20, 50 and so on, and the last.
std::vector<int> milestones_to(int last) {
    std::vector<int> generations{0};
    for (int decade = 1; decade < last; decade *= 10)
        for (int const step : {1, 2, 5})
            if (step * decade < last) generations.push_back(step * decade);
    if (last > 0) generations.push_back(last);
    return generations;
}

std::vector<PopulationRow> populations_of(Treatment const& treatment, std::vector<FinishedRun> const& runs) {
    std::vector<PopulationRow> rows;
    for (int const generation : milestones_to(common_length(runs) - 1)) {
        auto const mean_of = [&](auto column) {
            double sum = 0;
            for (FinishedRun const& run : runs)
                sum += static_cast<double>(run.progress[static_cast<std::size_t>(generation)].*column);
            return sum / static_cast<double>(runs.size());
        };
        rows.push_back({treatment.name, generation, static_cast<int>(runs.size()),
                        mean_of(&GenerationSummary::mean_reward), mean_of(&GenerationSummary::fronts),
                        mean_of(&GenerationSummary::tied), mean_of(&GenerationSummary::best_shaping),
                        mean_of(&GenerationSummary::shaping_at_max), mean_of(&GenerationSummary::mean_connections),
                        mean_of(&GenerationSummary::mean_hidden)});
    }
    return rows;
}

/// How fast the treatments of one task are, over the generations that all their runs have.
void add_speeds(CampaignPlan const& plan, std::vector<RewardCurves> const& targets, Results& results,
                std::vector<Milestone>& milestones) {
    if (targets.empty()) return;
    std::size_t length = common_length(targets.front());
    for (RewardCurves const& target : targets) length = std::min(length, common_length(target));
    int const last = static_cast<int>(length) - 1;
    std::vector<double> finals;
    for (RewardCurves const& target : targets)
        for (std::vector<double> const& curve : target.curves) finals.push_back(curve.back());
    std::string const unit = results.unit_of(targets.front().name).value_or(std::string{first_reward_unit});
    std::vector<double> levels = timed_levels(plan, unit, finals);
    // A row of speed.csv has as many levels as the others: equal ones of a task whose runs have all got the same.
    if (levels.empty() && !plan.tasks.empty()) levels.assign(first_reward_levels.size(), finals.front());
    for (RewardCurves const& target : targets) {
        results.speeds.push_back(speed_of(target.name, target.curves, last, levels));
        for (int const generation : milestones_to(last)) {
            double sum = 0;
            for (std::vector<double> const& curve : target.curves) sum += curve[static_cast<std::size_t>(generation)];
            milestones.push_back({target.name, generation, sum / static_cast<double>(target.curves.size())});
        }
    }
}

/// Treatments of different tasks are not compared.
void add_speeds(CampaignPlan const& plan, std::vector<RewardCurves> const& targets, Results& results) {
    std::vector<Milestone> milestones;
    for (TaskGroup const& group : task_groups(plan)) {
        std::vector<RewardCurves> of_task;
        for (RewardCurves const& target : targets) {
            if (std::find(group.treatments.begin(), group.treatments.end(), target.name) == group.treatments.end())
                continue;
            // Nor are rewards of different units: the first one's counts, as in figures 3 and 4.
            if (of_task.empty() || results.unit_of(target.name) == results.unit_of(of_task.front().name))
                of_task.push_back(target);
        }
        add_speeds(plan, of_task, results, milestones);
    }
    results.leads = leads_of(plan, milestones);
}

std::vector<double> best_rewards(std::vector<GenerationSummary> const& progress) {
    std::vector<double> rewards;
    for (GenerationSummary const& generation : progress) rewards.push_back(generation.best_reward);
    return rewards;
}

RewardCurves pooled(PoolPlan const& pool, std::vector<RewardCurves> const& targets) {
    RewardCurves all{pool.name, {}};
    for (RewardCurves const& target : targets)
        if (std::find(pool.treatments.begin(), pool.treatments.end(), target.name) != pool.treatments.end())
            all.curves.insert(all.curves.end(), target.curves.begin(), target.curves.end());
    return all;
}

void add_curve(RewardCurves const& runs, Results& results) {
    if (runs.curves.empty()) return;
    auto const rows = curve_of(runs);
    results.curves.insert(results.curves.end(), rows.begin(), rows.end());
}

std::vector<KnowledgeRow> knowledge_rows(CampaignPlan const& plan, CampaignDirectory const& directory,
                                         std::optional<Choice> const& choice) {
    std::vector<KnowledgeRow> rows;
    for (KnowledgePlan const& planned : plan.knowledge) {
        ChosenRun const* const source = choice ? choice->find(origin_of(plan, planned).name) : nullptr;
        if (source == nullptr || !is_there(directory.knowledge(planned.name))) continue;
        KnowledgeBase const base = read_knowledge_base(directory.knowledge(planned.name));
        KnowledgeRow row{planned.name,
                         base.provenance().kind,
                         source->run,
                         source->seed,
                         source->reward,
                         base.provenance().individuals,
                         base.provenance().windows,
                         base.size(),
                         0,
                         0,
                         0,
                         0};
        if (base.size() > 0) {
            auto const [least, greatest] = std::minmax_element(base.values().begin(), base.values().end());
            row.least_value = *least;
            row.greatest_value = *greatest;
            row.at_greatest = static_cast<int>(std::count(base.values().begin(), base.values().end(), *greatest));
            for (int feature = 0; feature < base.size(); ++feature) row.shown_once += base.count(feature) == 1;
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}   // namespace

KnowledgePlan const& origin_of(CampaignPlan const& plan, KnowledgePlan const& knowledge) {
    return knowledge.base.empty() ? knowledge : origin_of(plan, plan.knowledge_base(knowledge.base));
}

std::vector<double> Results::final_rewards(std::string_view treatment) const {
    std::vector<double> rewards;
    for (RunRow const& run : runs)
        if (run.treatment == treatment) rewards.push_back(run.reward);
    return rewards;
}

int Results::last_generation(std::string_view treatment) const {
    int last = 0;
    for (CurveRow const& row : curves)
        if (treatment.empty() || row.treatment == treatment) last = std::max(last, row.generation);
    return last;
}

std::optional<std::string> Results::unit_of(std::string_view treatment) const {
    for (RunRow const& run : runs)
        if (run.treatment == treatment) return run.reward_unit;
    return std::nullopt;
}

std::string Results::reward_unit(CampaignPlan const& plan) const {
    for (std::string const& name : plan.report_order)
        if (auto unit = unit_of(name)) return *std::move(unit);
    for (Treatment const& source : plan.sources)
        if (auto unit = unit_of(source.name)) return *std::move(unit);
    return std::string{first_reward_unit};
}

bool Results::has_several_units(CampaignPlan const& plan) const {
    std::string const first = reward_unit(plan);
    return std::any_of(plan.report_order.begin(), plan.report_order.end(),
                       [&](std::string const& name) { return unit_of(name).value_or(first) != first; });
}

std::string_view Results::reward_word() const {
    bool const first =
        std::all_of(runs.begin(), runs.end(), [](RunRow const& run) { return run.reward_unit == first_reward_unit; });
    return lore::reward_word(first ? first_reward_unit : "");
}

bool Results::are_counts() const {
    return std::all_of(runs.begin(), runs.end(),
                       [](RunRow const& run) { return run.reward >= 0 && is_whole(run.reward); });
}

Results collect_results(CampaignPlan const& plan, CampaignDirectory const& directory) {
    Results results;
    std::vector<RewardCurves> targets;
    for (std::string const& name : all_treatments(plan)) {
        Treatment const& treatment = plan.treatment(name);
        auto const runs = finished_runs(plan, directory, treatment);
        if (runs.empty()) continue;
        for (FinishedRun const& run : runs) results.runs.push_back(row_of(treatment, run));
        RewardCurves rewards{name, {}};
        for (FinishedRun const& run : runs) rewards.curves.push_back(best_rewards(run.progress));
        add_curve(rewards, results);
        auto const populations = populations_of(treatment, runs);
        results.populations.insert(results.populations.end(), populations.begin(), populations.end());
        if (!plan.is_source(name)) targets.push_back(std::move(rewards));
    }
    for (std::string const& name : plan.figures.figure3)
        if (PoolPlan const* const pool = plan.pool(name)) add_curve(pooled(*pool, targets), results);
    add_speeds(plan, targets, results);
    results.bases = knowledge_rows(plan, directory, recorded_choices(plan, directory));
    return results;
}

}   // namespace lore
