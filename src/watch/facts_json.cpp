#include <lore/core/whole_number.h>
#include <lore/watch/facts.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) { return std::round(value * 1000) / 1000; }

bool is_first(std::string_view unit) { return unit == first_reward_unit; }

/// A mean of rewards: 3 decimals, or 5 digits where they may be small.
double shown(double value, std::string_view unit) {
    return is_first(unit) ? rounded(value) : std::stod(fmt::format("{:.5g}", value));
}

Json step_json(StepWithState const& entry) {
    auto const& [step, state] = entry;
    Json json{{"name", step.name}, {"group", step.group}, {"state", name(state.status)}, {"reason", state.reason}};
    if (state.generations == 0) return json;   // no run
    json["generation"] = state.generation;
    json["generations"] = state.generations;
    json[std::string{reward_word(state.reward_unit)}] = json_number<Json>(state.best_reward);
    if (!is_first(state.reward_unit)) json["reward_unit"] = state.reward_unit;
    json["seconds"] = rounded(state.seconds);
    return json;
}

Json treatment_json(TreatmentFacts const& facts) {
    Json curve = Json::array();
    for (MeanPoint const& point : facts.curve)
        curve.push_back({point.generation, shown(point.mean, facts.reward_unit), point.runs});
    std::string const word{reward_word(facts.reward_unit)};
    Json json{{"name", facts.name},
              {"label", facts.label},
              {"runs", facts.planned},
              {"started", facts.started},
              {"done", facts.done},
              {"running", facts.running},
              {"failed", facts.failed},
              {"mean_" + word, shown(facts.mean_reward, facts.reward_unit)},
              {"best_" + word, json_number<Json>(facts.best_reward)},
              {"curve", curve}};
    if (!is_first(facts.reward_unit)) json["reward_unit"] = facts.reward_unit;
    if (facts.is_source) json["source"] = true;
    if (!facts.target.empty()) {
        json["target"] = facts.target;
        json["target_label"] = facts.target_label;
    }
    return json;
}

template <class Items, class Function>
Json list(Items const& items, Function const& of_item) {
    Json array = Json::array();
    for (auto const& item : items) array.push_back(of_item(item));
    return array;
}

}   // namespace

int CampaignFacts::count(StepStatus status) const {
    return static_cast<int>(std::count_if(steps.begin(), steps.end(),
                                          [&](StepWithState const& entry) { return entry.state.status == status; }));
}

std::string facts_json(CampaignFacts const& facts) {
    Json counts = Json::object();
    for (StepStatus const status :
         {StepStatus::done, StepStatus::running, StepStatus::interrupted, StepStatus::failed, StepStatus::missing})
        counts[std::string{name(status)}] = facts.count(status);
    Json const failures = list(facts.failures, [](FailureFacts const& failure) {
        return Json{{"step", failure.step}, {"reason", failure.reason}, {"log", failure.log}, {"tail", failure.tail}};
    });
    Json const champions = list(facts.champions, [](Champion const& champion) {
        Json json{{"run", champion.run},
                  {"label", champion.label},
                  {std::string{reward_word(champion.reward_unit)}, json_number<Json>(champion.reward)},
                  {"signature", champion.signature},
                  {"problem", champion.problem}};
        if (!is_first(champion.reward_unit)) json["reward_unit"] = champion.reward_unit;
        return json;
    });
    Json const document{{"title", facts.title},
                        {"directory", facts.directory},
                        {"time", facts.time},
                        {"notice", facts.notice},
                        {"counts", counts},
                        {"share", rounded(facts.share)},
                        {"seconds_left", facts.seconds_left ? Json(std::round(*facts.seconds_left)) : Json()},
                        {"treatments", list(facts.treatments, treatment_json)},
                        {"failures", failures},
                        {"champions", champions},
                        {"steps", list(facts.steps, step_json)}};
    return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}   // namespace lore
