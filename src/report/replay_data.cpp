#include "replay_data.h"

#include <lore/report/replay_page.h>

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

double to_nearest(double value, double scale) { return std::round(value * scale) / scale; }

/// With 5 digits, as many as a picture can show.
double shortened(double value) { return std::stod(fmt::format("{:.5g}", value)); }

/// null: not found.
template <class Shorten>
Json values_of(PanelValues const& panel, Shorten const& shorten) {
    Json values = Json::array();
    for (double const value : panel.values) values.push_back(std::isnan(value) ? Json{} : Json(shorten(value)));
    return values;
}

Json arena_replay_data(Replay const& replay) {
    std::vector<double> x, y, theta;
    for (std::size_t k = 0; k < replay.steps.size(); ++k) {
        x.push_back(to_nearest(replay.steps[k].x, 10));
        y.push_back(to_nearest(replay.steps[k].y, 10));
        theta.push_back(to_nearest(replay.arena->steps[k].theta, 100));
    }
    return {{"arena", Json::parse(page_arena(replay.arena->scene))},
            {"x", x},
            {"y", y},
            {"theta", theta},
            {"events", Json::parse(page_events(replay.arena->steps))}};
}

/// [step, reward so far], one at each change.
Json rewards_of(Replay const& replay) {
    Json rewards = Json::array();
    double last = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < replay.steps.size(); ++k) {
        double const reward = shortened(replay.steps[k].reward);
        if (reward == last) continue;
        last = reward;
        rewards.push_back({k, reward});
    }
    return rewards;
}

Json world_replay_data(Replay const& replay) {
    std::vector<double> x, y;
    for (ReplayStep const& step : replay.steps) {
        x.push_back(shortened(step.x));
        y.push_back(shortened(step.y));
    }
    return {{"world",
             {{"width", shortened(replay.scene.width)},
              {"height", shortened(replay.scene.height)},
              {"svg", replay.scene.svg}}},
            {"unit", replay.reward_unit},
            {"x", x},
            {"y", y},
            {"rewards", rewards_of(replay)}};
}

}   // namespace

Json replay_data(Replay const& replay, PanelValues const* panel, bool as_arena) {
    Json data = as_arena ? arena_replay_data(replay) : world_replay_data(replay);
    data["values"] = Json::array();
    if (panel == nullptr || panel->values.empty()) return data;
    auto const to_thousandth = [](double value) { return to_nearest(value, 1000); };
    data["values"] = as_arena ? values_of(*panel, to_thousandth) : values_of(*panel, shortened);
    data["window_length"] = panel->window_length;
    return data;
}

std::string replay_json(std::vector<Replay> const& replays) {
    bool const arenas = all_in_arenas(replays);
    Json data = Json::array();
    for (Replay const& replay : replays) data.push_back(replay_data(replay, nullptr, arenas));
    return data.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}   // namespace lore
