#include <lore/watch/facts.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) { return std::round(value * 1000) / 1000; }

Json step_json(StepWithState const& entry) {
    auto const& [step, state] = entry;
    Json json{{"name", step.name}, {"group", step.group}, {"state", name(state.status)}, {"reason", state.reason}};
    if (state.generations == 0) return json;   // no run
    json["generation"] = state.generation;
    json["generations"] = state.generations;
    json["balls"] = state.best_balls;
    json["seconds"] = rounded(state.seconds);
    return json;
}

Json treatment_json(TreatmentFacts const& facts) {
    Json curve = Json::array();
    for (MeanPoint const& point : facts.curve) curve.push_back({point.generation, rounded(point.mean), point.runs});
    return {{"name", facts.name},
            {"label", facts.label},
            {"runs", facts.planned},
            {"started", facts.started},
            {"done", facts.done},
            {"running", facts.running},
            {"failed", facts.failed},
            {"mean_balls", rounded(facts.mean_balls)},
            {"best_balls", facts.best_balls},
            {"curve", curve}};
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
        return Json{{"run", champion.run},
                    {"label", champion.label},
                    {"balls", champion.balls},
                    {"signature", champion.signature},
                    {"problem", champion.problem}};
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
