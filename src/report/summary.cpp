#include "summary.h"

#include "panels.h"

#include <lore/core/whole_number.h>
#include <lore/statistics/quantiles.h>

#include <algorithm>

#include <nlohmann/json.hpp>

namespace lore {

namespace {

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
    entry["standard_deviation"] = rewards.size() > 1 ? Json(standard_deviation(rewards)) : Json();
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

Json json_of(SpeedRow const& speed, std::string const& word) {
    Json times = Json::array();
    for (TimeToLevel const& to : speed.to)
        times.push_back({{word, json_number<Json>(to.level)},
                         {"reached", to.reached},
                         {"mean", to.mean},
                         {"low", to.low},
                         {"high", to.high},
                         {"median", to.median}});
    return {
        {"time_to_" + word, times}, {"area", speed.area}, {"area_low", speed.area_low}, {"area_high", speed.area_high}};
}

/// Adds the last generation of the treatment's curve.
void describe_end(std::vector<CurveRow> const& curves, std::string_view treatment, Json& entry) {
    auto const last =
        std::find_if(curves.rbegin(), curves.rend(), [&](CurveRow const& row) { return row.treatment == treatment; });
    if (last == curves.rend()) return;
    entry["generation"] = last->generation;
    entry["mean_low"] = last->low;
    entry["mean_high"] = last->high;
}

Json json_of(Treatment const& treatment, CampaignPlan const& plan, Results const& results) {
    Json entry{{"treatment", treatment.name}, {"label", treatment.label}, {"runs_planned", treatment.runs}};
    if (!treatment.target.empty()) entry["target"] = treatment.target;
    if (results.has_several_units(plan))
        if (auto const unit = results.unit_of(treatment.name)) entry["reward_unit"] = *unit;
    auto const rewards = results.final_rewards(treatment.name);
    entry["runs"] = rewards.size();
    if (rewards.empty()) return entry;
    describe_rewards(rewards, entry);
    for (SpeedRow const& speed : results.speeds)
        if (speed.treatment == treatment.name) entry.update(json_of(speed, std::string{results.reward_word()}));
    describe_end(results.curves, treatment.name, entry);
    return entry;
}

Json json_of(KnowledgeRow const& base, CampaignPlan const& plan, std::string const& word) {
    Json entry{{"knowledge", base.knowledge}};
    if (std::string const label = knowledge_label(plan, base.knowledge); label != base.knowledge)
        entry["label"] = label;
    entry.update({{"kind", base.kind},
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
    return entry;
}

/// A summary of results without leads does not have them.
void add_leads(std::vector<LeadRow> const& leads, Json& document) {
    for (LeadRow const& lead : leads)
        document["leads"].push_back({{"treatment", lead.treatment},
                                     {"policy", lead.policy},
                                     {"none", lead.none},
                                     {"generation", lead.generation},
                                     {"share", lead.share}});
}

}   // namespace

std::string summary_json(CampaignPlan const& plan, Results const& results, Findings const& findings) {
    std::string const word{results.reward_word()};
    Json document;
    document["title"] = plan.title;
    if (word != first_reward_unit && !results.has_several_units(plan))
        document["reward_unit"] = results.reward_unit(plan);
    if (plan.sources.size() != 1 || plan.sources.front().name != "source") {
        document["sources"] = Json::array();
        for (Treatment const& source : plan.sources) document["sources"].push_back(source.name);
    }
    bool complete = true;
    document["treatments"] = Json::array();
    for (std::string const& name : all_treatments(plan)) {
        Treatment const& treatment = plan.treatment(name);
        document["treatments"].push_back(json_of(treatment, plan, results));
        complete = complete && static_cast<int>(results.final_rewards(name).size()) == treatment.runs;
    }
    document["complete"] = complete;
    document["comparisons"] = json_of(findings.comparisons);
    document["knowledge"] = Json::array();
    for (KnowledgeRow const& base : results.bases) document["knowledge"].push_back(json_of(base, plan, word));
    add_pools(plan, results, findings.planned, document);
    if (!plan.figures.figure3.empty()) document["figure3"] = plan.figures.figure3;
    add_matrix(findings.matrix, document);
    add_leads(results.leads, document);
    return document.dump(2) + "\n";
}

std::vector<std::string> tasks_in_summary(std::string_view text) {
    std::vector<std::string> tasks;
    Json const document = Json::parse(text, nullptr, false);
    if (!document.is_object() || !document.contains("treatments")) return tasks;
    for (Json const& entry : document["treatments"])
        if (entry.is_object() && entry.contains("target") && entry["target"].is_string())
            tasks.push_back(entry["target"]);
    return tasks;
}

}   // namespace lore
