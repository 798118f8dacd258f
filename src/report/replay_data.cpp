#include "replay_data.h"

#include <lore/report/replay_page.h>

#include <cmath>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double scale) { return std::round(value * scale) / scale; }
double hundredths(double value) { return rounded(value, 100); }

Json arena_data(Scene const& scene) {
    Json walls = Json::array(), doors = walls, balls = walls;
    auto const corners = [](Rect const& r) {
        return Json{hundredths(r.x0), hundredths(r.x1), hundredths(r.y0), hundredths(r.y1)};
    };
    for (Rect const& wall : scene.walls) walls.push_back(corners(wall));
    for (Rect const& door : scene.doors) doors.push_back(corners(door));
    for (Point const& ball : scene.ball_positions) balls.push_back({hundredths(ball.x), hundredths(ball.y)});
    return {{"width", hundredths(scene.width)},
            {"height", hundredths(scene.height)},
            {"walls", walls},
            {"doors", doors},
            {"balls", balls},
            {"basket",
             {hundredths(scene.basket_center.x), hundredths(scene.basket_center.y), hundredths(scene.basket_radius)}},
            {"switch", {hundredths(scene.switch_position.x), hundredths(scene.switch_position.y)}},
            {"radius", hundredths(scene.robot_radius)}};
}

/// [step, carrying, door open, lamp lit, balls on the floor, collected], one at each change.
Json events_of(Replay const& replay) {
    Json events = Json::array(), last;
    for (std::size_t k = 0; k < replay.steps.size(); ++k) {
        ReplayStep const& s = replay.steps[k];
        Json const now{static_cast<int>(s.carrying), static_cast<int>(s.door_open), static_cast<int>(s.switch_on),
                       s.balls_mask, s.collected};
        if (now == last) continue;
        last = now;
        events.push_back(now);
        events.back().insert(events.back().begin(), k);
    }
    return events;
}

}   // namespace

Json replay_data(Replay const& replay, PanelValues const* panel) {
    std::vector<double> x, y, theta, values;
    for (ReplayStep const& s : replay.steps) {
        x.push_back(rounded(s.x, 10));
        y.push_back(rounded(s.y, 10));
        theta.push_back(hundredths(s.theta));
    }
    if (panel != nullptr)
        for (double const value : panel->values) values.push_back(rounded(value, 1000));
    return {{"arena", arena_data(replay.scene)}, {"x", x},          {"y", y}, {"theta", theta},
            {"events", events_of(replay)},       {"values", values}};
}

std::string replay_json(std::vector<Replay> const& replays) {
    Json data = Json::array();
    for (Replay const& replay : replays) data.push_back(replay_data(replay, nullptr));
    return data.dump();
}

}   // namespace lore
