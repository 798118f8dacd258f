#include "comparison.h"

#include "findings.h"

#include <lore/core/whole_number.h>
#include <lore/statistics/holm.h>
#include <lore/statistics/mann_whitney.h>
#include <lore/statistics/quantiles.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

Comparison compared(std::string const& a, std::string const& b, std::vector<double> const& first,
                    std::vector<double> const& second) {
    MannWhitney const test = mann_whitney(first, second);
    return {a,      b,      static_cast<int>(first.size()),    static_cast<int>(second.size()), test.u,
            test.p, test.p, vargha_delaney_a12(first, second), bootstrap_a12(first, second),    test.exact};
}

using Json = nlohmann::ordered_json;

Json json_of(std::vector<Comparison> const& comparisons) {
    Json list = Json::array();
    for (Comparison const& c : comparisons)
        list.push_back({{"a", c.a},
                        {"b", c.b},
                        {"n_a", c.n_a},
                        {"n_b", c.n_b},
                        {"u", c.u},
                        {"p", c.p},
                        {"p_holm", c.p_holm},
                        {"a12", c.a12},
                        {"a12_low", c.a12_band.low},
                        {"a12_high", c.a12_band.high},
                        {"exact", c.exact}});
    return list;
}

/// Precondition: there are some.
void describe_rewards(std::vector<double> const& rewards, Json& entry) {
    entry["mean"] = mean(rewards);
    entry["standard_deviation"] = standard_deviation(rewards);
    entry["least"] = quantile(rewards, 0);
    entry["lower_quartile"] = quantile(rewards, 0.25);
    entry["median"] = quantile(rewards, 0.5);
    entry["upper_quartile"] = quantile(rewards, 0.75);
    entry["most"] = quantile(rewards, 1);
}

/// A campaign without pools has a summary without them.
void add_pools(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& planned,
               Json& document) {
    if (plan.pools.empty()) return;
    document["pools"] = Json::array();
    for (PoolPlan const& pool : plan.pools) {
        auto const rewards = rewards_of(plan, results, pool.name);
        Json entry{
            {"pool", pool.name}, {"label", pool.label}, {"treatments", pool.treatments}, {"runs", rewards.size()}};
        if (!rewards.empty()) describe_rewards(rewards, entry);
        document["pools"].push_back(std::move(entry));
    }
    document["planned"] = json_of(planned);
}

/// A campaign without [transfer] has a summary without it.
void add_matrix(std::vector<MatrixField> const& fields, Json& document) {
    if (fields.empty()) return;
    document["transfer"] = Json::array();
    for (MatrixField const& f : fields) {
        Json entry{{"source", f.pair.source}, {"target", f.pair.target}};
        if (!f.why.empty()) entry["why"] = f.why;
        else
            entry.update({{"treatment", f.pair.treatment},
                          {"none", f.pair.none},
                          {"unit", f.unit},
                          {"generation", f.generation},
                          {"n", f.n},
                          {"n_none", f.n_none},
                          {"difference", f.difference},
                          {"difference_low", f.difference_band.low},
                          {"difference_high", f.difference_band.high},
                          {"a12", f.a12},
                          {"a12_low", f.a12_band.low},
                          {"a12_high", f.a12_band.high},
                          {"p", f.p},
                          {"p_holm", f.p_holm}});
        document["transfer"].push_back(std::move(entry));
    }
}

/// Of all of these together.
void correct(std::vector<Comparison>& comparisons) {
    std::vector<double> p_values;
    for (Comparison const& comparison : comparisons) p_values.push_back(comparison.p);
    std::vector<double> const adjusted = holm_adjusted(p_values);
    for (std::size_t k = 0; k < comparisons.size(); ++k) comparisons[k].p_holm = adjusted[k];
}

}   // namespace

std::vector<Comparison> compare_treatments(CampaignPlan const& plan, Results const& results) {
    std::vector<Comparison> comparisons;
    for (std::size_t i = 0; i < plan.report_order.size(); ++i) {
        for (std::size_t j = i + 1; j < plan.report_order.size(); ++j) {
            std::string const &a = plan.report_order[i], &b = plan.report_order[j];
            if (plan.treatment(a).target != plan.treatment(b).target) continue;
            auto const first = results.final_rewards(a), second = results.final_rewards(b);
            if (!first.empty() && !second.empty()) comparisons.push_back(compared(a, b, first, second));
        }
    }
    correct(comparisons);
    return comparisons;
}

std::vector<double> rewards_of(CampaignPlan const& plan, Results const& results, std::string_view name) {
    PoolPlan const* const pool = plan.pool(name);
    if (pool == nullptr) return results.final_rewards(name);
    std::vector<double> rewards;
    for (RunRow const& run : results.runs)
        if (std::find(pool->treatments.begin(), pool->treatments.end(), run.treatment) != pool->treatments.end())
            rewards.push_back(run.reward);
    return rewards;
}

std::vector<Comparison> compare_pools(CampaignPlan const& plan, Results const& results) {
    std::vector<Comparison> comparisons;
    for (PoolPlan const& pool : plan.pools)
        for (std::string const& other : pool.against) {
            auto const first = rewards_of(plan, results, pool.name), second = rewards_of(plan, results, other);
            if (!first.empty() && !second.empty()) comparisons.push_back(compared(pool.name, other, first, second));
        }
    correct(comparisons);
    return comparisons;
}

std::string pools_csv(std::vector<Comparison> const& comparisons) {
    std::string text = "a,b,n_a,n_b,u,p,p_holm,a12,a12_low,a12_high\n";
    for (Comparison const& c : comparisons)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", c.a, c.b, c.n_a, c.n_b, c.u, c.p, c.p_holm, c.a12,
                            c.a12_band.low, c.a12_band.high);
    return text;
}

std::string comparisons_csv(std::vector<Comparison> const& comparisons) {
    std::string text = "a,b,n_a,n_b,u,p,p_holm,a12\n";
    for (Comparison const& c : comparisons)
        text += fmt::format("{},{},{},{},{},{},{},{}\n", c.a, c.b, c.n_a, c.n_b, c.u, c.p, c.p_holm, c.a12);
    return text;
}

std::string summary_json(CampaignPlan const& plan, Results const& results, Findings const& findings) {
    std::string const word{results.reward_word()};
    Json document;
    document["title"] = plan.title;
    bool const several_units = results.has_several_units(plan);
    if (word != first_reward_unit && !several_units) document["reward_unit"] = results.reward_unit(plan);
    if (plan.sources.size() != 1 || plan.sources.front().name != "source") {
        document["sources"] = Json::array();
        for (Treatment const& source : plan.sources) document["sources"].push_back(source.name);
    }

    auto describe = [&](Treatment const& treatment) {
        Json entry{{"treatment", treatment.name}, {"label", treatment.label}, {"runs_planned", treatment.runs}};
        if (!treatment.target.empty()) entry["target"] = treatment.target;
        if (several_units)
            if (auto const unit = results.unit_of(treatment.name)) entry["reward_unit"] = *unit;
        auto const rewards = results.final_rewards(treatment.name);
        entry["runs"] = rewards.size();
        if (rewards.empty()) return entry;
        describe_rewards(rewards, entry);
        for (SpeedRow const& speed : results.speeds) {
            if (speed.treatment != treatment.name) continue;
            Json& times = entry["time_to_" + word] = Json::array();
            for (std::size_t k = 0; k < speed.to.size(); ++k)
                times.push_back({{word, json_number<Json>(speed.to[k].level)},
                                 {"reached", speed.to[k].reached},
                                 {"mean", speed.to[k].mean},
                                 {"low", speed.to[k].low},
                                 {"high", speed.to[k].high},
                                 {"median", speed.to[k].median}});
            entry["area"] = speed.area;
            entry["area_low"] = speed.area_low;
            entry["area_high"] = speed.area_high;
        }
        for (auto row = results.curves.rbegin(); row != results.curves.rend(); ++row) {
            if (row->treatment != treatment.name) continue;
            entry["generation"] = row->generation;
            entry["mean_low"] = row->low;
            entry["mean_high"] = row->high;
            break;
        }
        return entry;
    };
    bool complete = true;
    document["treatments"] = Json::array();
    for (std::string const& name : all_treatments(plan)) {
        document["treatments"].push_back(describe(plan.treatment(name)));
        complete = complete && static_cast<int>(results.final_rewards(name).size()) == plan.treatment(name).runs;
    }
    document["complete"] = complete;

    document["comparisons"] = json_of(findings.comparisons);
    document["knowledge"] = Json::array();
    for (KnowledgeRow const& base : results.bases)
        document["knowledge"].push_back({{"knowledge", base.knowledge},
                                         {"kind", base.kind},
                                         {"source_run", base.source_run},
                                         {"seed", base.seed},
                                         {word, json_number<Json>(base.reward)},
                                         {"individuals", base.individuals},
                                         {"windows", base.windows},
                                         {"features", base.features},
                                         {"least_value", base.least_value},
                                         {"greatest_value", base.greatest_value},
                                         {"at_greatest", base.at_greatest},
                                         {"shown_once", base.shown_once}});
    add_pools(plan, results, findings.planned, document);
    add_matrix(findings.matrix, document);
    if (results.leads.empty()) return document.dump(2) + "\n";
    document["leads"] = Json::array();
    for (LeadRow const& lead : results.leads)
        document["leads"].push_back({{"treatment", lead.treatment},
                                     {"policy", lead.policy},
                                     {"none", lead.none},
                                     {"generation", lead.generation},
                                     {"share", lead.share}});
    return document.dump(2) + "\n";
}

std::string_view significance_mark(double p) { return p < 1e-3 ? "**" : p < 1e-2 ? "*" : ""; }
std::string p_text(double p) { return p < 1e-3 ? fmt::format("{:.1e}", p) : fmt::format("{:.3f}", p); }

}   // namespace lore
