#include "comparison.h"

#include <lore/statistics/holm.h>
#include <lore/statistics/mann_whitney.h>
#include <lore/statistics/quantiles.h>

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a decimal point.
Json number(double reward) {
    if (std::abs(reward) < 1e15 && reward == std::round(reward)) return static_cast<std::int64_t>(reward);
    return reward;
}

}   // namespace

std::vector<Comparison> compare_treatments(CampaignPlan const& plan, Results const& results) {
    std::vector<Comparison> comparisons;
    std::vector<double> p_values;
    for (std::size_t i = 0; i < plan.report_order.size(); ++i) {
        for (std::size_t j = i + 1; j < plan.report_order.size(); ++j) {
            std::string const &a = plan.report_order[i], &b = plan.report_order[j];
            auto const first = results.final_rewards(a), second = results.final_rewards(b);
            if (first.empty() || second.empty()) continue;
            MannWhitney const test = mann_whitney(first, second);
            comparisons.push_back({a, b, static_cast<int>(first.size()), static_cast<int>(second.size()), test.u,
                                   test.p, test.p, vargha_delaney_a12(first, second), bootstrap_a12(first, second),
                                   test.exact});
            p_values.push_back(test.p);
        }
    }
    std::vector<double> const adjusted = holm_adjusted(p_values);
    for (std::size_t k = 0; k < comparisons.size(); ++k) comparisons[k].p_holm = adjusted[k];
    return comparisons;
}

std::string comparisons_csv(std::vector<Comparison> const& comparisons) {
    std::string text = "a,b,n_a,n_b,u,p,p_holm,a12\n";
    for (Comparison const& c : comparisons)
        text += fmt::format("{},{},{},{},{},{},{},{}\n", c.a, c.b, c.n_a, c.n_b, c.u, c.p, c.p_holm, c.a12);
    return text;
}

std::string summary_json(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& comparisons) {
    std::string const word{results.reward_word()};
    Json document;
    document["title"] = plan.title;
    if (word != first_reward_unit) document["reward_unit"] = results.reward_unit(plan);

    auto describe = [&](Treatment const& treatment) {
        Json entry{{"treatment", treatment.name}, {"label", treatment.label}, {"runs_planned", treatment.runs}};
        auto const rewards = results.final_rewards(treatment.name);
        entry["runs"] = rewards.size();
        if (rewards.empty()) return entry;
        entry["mean"] = mean(rewards);
        entry["standard_deviation"] = standard_deviation(rewards);
        entry["least"] = quantile(rewards, 0);
        entry["lower_quartile"] = quantile(rewards, 0.25);
        entry["median"] = quantile(rewards, 0.5);
        entry["upper_quartile"] = quantile(rewards, 0.75);
        entry["most"] = quantile(rewards, 1);
        for (SpeedRow const& speed : results.speeds) {
            if (speed.treatment != treatment.name) continue;
            Json& times = entry["time_to_" + word] = Json::array();
            for (std::size_t k = 0; k < speed.to.size(); ++k)
                times.push_back({{word, number(speed.to[k].level)},
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
    bool complete = static_cast<int>(results.final_rewards(plan.source.name).size()) == plan.source.runs;
    document["treatments"] = Json::array({describe(plan.source)});
    for (std::string const& name : plan.report_order) {
        document["treatments"].push_back(describe(plan.treatment(name)));
        complete = complete && static_cast<int>(results.final_rewards(name).size()) == plan.treatment(name).runs;
    }
    document["complete"] = complete;

    document["comparisons"] = Json::array();
    for (Comparison const& c : comparisons)
        document["comparisons"].push_back({{"a", c.a},
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
    document["knowledge"] = Json::array();
    for (KnowledgeRow const& base : results.bases)
        document["knowledge"].push_back({{"knowledge", base.knowledge},
                                         {"kind", base.kind},
                                         {"source_run", base.source_run},
                                         {"seed", base.seed},
                                         {word, number(base.reward)},
                                         {"individuals", base.individuals},
                                         {"windows", base.windows},
                                         {"features", base.features},
                                         {"least_value", base.least_value},
                                         {"greatest_value", base.greatest_value},
                                         {"at_greatest", base.at_greatest},
                                         {"shown_once", base.shown_once}});
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
