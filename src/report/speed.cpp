#include "speed.h"

#include "results.h"

#include <lore/statistics/bootstrap.h>
#include <lore/statistics/quantiles.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <cassert>
#include <optional>

namespace lore {

namespace {

/// The first generation with so much reward, or nothing.
std::optional<int> first_with(std::vector<double> const& curve, double level, int generations) {
    for (int g = 0; g <= generations; ++g)
        if (curve[static_cast<std::size_t>(g)] >= level) return g;
    return std::nullopt;
}

double area_under(std::vector<double> const& curve, int generations) {
    double area = 0;
    for (std::size_t g = 0; std::cmp_less(g, generations); ++g) area += (curve[g] + curve[g + 1]) / 2.0;
    return area;
}

/// The bases that the treatment takes something of, if any.
std::vector<std::string> const& bases_of(Treatment const& treatment) {
    return treatment.knowledge.empty() ? treatment.clone_of : treatment.knowledge;
}

/// The bases by Algorithm 1 that these were derived from, those of the source runs: each once, sorted.
std::vector<std::string> origins_of(CampaignPlan const& plan, std::vector<std::string> const& bases) {
    std::vector<std::string> origins;
    for (std::string const& name : bases) origins.push_back(origin_of(plan, plan.knowledge_base(name)).name);
    std::sort(origins.begin(), origins.end());
    origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
    return origins;
}

Treatment const* find_target(CampaignPlan const& plan, auto const& fits) {
    for (std::string const& name : plan.report_order)
        if (Treatment const& treatment = plan.treatment(name); fits(treatment)) return &treatment;
    return nullptr;
}

double const* reward_at(std::vector<Milestone> const& milestones, std::string_view treatment, int generation) {
    auto const found = std::find_if(milestones.begin(), milestones.end(), [&](Milestone const& m) {
        return m.treatment == treatment && m.generation == generation;
    });
    return found == milestones.end() ? nullptr : &found->reward;
}

}   // namespace

SpeedRow speed_of(std::string treatment, std::span<std::vector<double> const> curves, int generations,
                  std::span<double const> levels) {
    assert(!curves.empty());
    SpeedRow row;
    row.treatment = std::move(treatment);
    row.runs = static_cast<int>(curves.size());
    row.generations = generations;
    for (double const level : levels) row.to.push_back({.level = level});
    std::vector<std::vector<double>> measures;   // a run each: its times, then its area
    for (std::vector<double> const& curve : curves) {
        measures.emplace_back();
        for (std::size_t k = 0; k < levels.size(); ++k) {
            auto const first = first_with(curve, levels[k], generations);
            row.to[k].reached += first.has_value();
            measures.back().push_back(first.value_or(generations));
        }
        measures.back().push_back(area_under(curve, generations));
    }
    MeanBand const band = bootstrap_mean_band(measures);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        std::vector<double> times;
        for (std::vector<double> const& of_run : measures) times.push_back(of_run[k]);
        row.to[k].mean = band.mean[k];
        row.to[k].low = band.low[k];
        row.to[k].high = band.high[k];
        row.to[k].median = quantile(times, 0.5);
    }
    row.area = band.mean.back();
    row.area_low = band.low.back();
    row.area_high = band.high.back();
    return row;
}

std::vector<double> timed_levels(CampaignPlan const& plan, std::string_view reward_unit,
                                 std::span<double const> finals) {
    if (!plan.levels.empty()) return plan.levels;
    if (reward_unit == first_reward_unit) return {first_reward_levels.begin(), first_reward_levels.end()};
    if (finals.empty()) return {};
    auto const [worst, best] = std::minmax_element(finals.begin(), finals.end());
    if (*worst == *best) return {};
    std::vector<double> levels;
    for (double const share : {0.25, 0.5, 0.75}) levels.push_back(*worst + share * (*best - *worst));
    return levels;
}

std::vector<LeadRow> leads_of(CampaignPlan const& plan, std::vector<Milestone> const& milestones) {
    std::vector<LeadRow> rows;
    for (std::string const& name : plan.report_order) {
        Treatment const& treatment = plan.treatment(name);
        if (bases_of(treatment).empty()) continue;
        std::vector<std::string> const origins = origins_of(plan, bases_of(treatment));
        Treatment const* const policy = find_target(plan, [&](Treatment const& t) {
            return origins_of(plan, t.policy_of) == origins && t.knowledge.empty() && t.name != name &&
                   t.config == treatment.config && t.target == treatment.target;
        });
        if (policy == nullptr) continue;
        Treatment const* const none = find_target(plan, [&](Treatment const& t) {
            return bases_of(t).empty() && t.policy_of.empty() && t.config == policy->config &&
                   t.target == policy->target && t.overrides == policy->overrides;
        });
        if (none == nullptr) continue;
        for (Milestone const& milestone : milestones) {
            if (milestone.treatment != name) continue;
            int const generation = milestone.generation;
            double const* const of_policy = reward_at(milestones, policy->name, generation);
            double const* const of_none = reward_at(milestones, none->name, generation);
            if (of_policy == nullptr || of_none == nullptr || *of_policy <= *of_none) continue;
            rows.push_back({name, policy->name, none->name, generation, milestone.reward, *of_policy, *of_none,
                            (milestone.reward - *of_none) / (*of_policy - *of_none)});
        }
    }
    return rows;
}

}   // namespace lore
