#include <lore/arena_view/replay.h>

#include <cmath>

#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

double hundredths(double value) { return std::round(value * 100) / 100; }

}   // namespace

std::string page_arena(ArenaScene const& scene) {
    Json walls = Json::array(), doors = walls, balls = walls;
    auto const corners = [](Rect const& r) {
        return Json{hundredths(r.x0), hundredths(r.x1), hundredths(r.y0), hundredths(r.y1)};
    };
    for (Rect const& wall : scene.walls) walls.push_back(corners(wall));
    for (Rect const& door : scene.doors) doors.push_back(corners(door));
    for (Point const& ball : scene.ball_positions) balls.push_back({hundredths(ball.x), hundredths(ball.y)});
    Json const json{
        {"width", hundredths(scene.width)},
        {"height", hundredths(scene.height)},
        {"walls", walls},
        {"doors", doors},
        {"balls", balls},
        {"basket",
         {hundredths(scene.basket_center.x), hundredths(scene.basket_center.y), hundredths(scene.basket_radius)}},
        {"switch", {hundredths(scene.switch_position.x), hundredths(scene.switch_position.y)}},
        {"radius", hundredths(scene.robot_radius)}};
    return json.dump();
}

std::string page_events(std::span<ArenaStep const> steps) {
    Json events = Json::array(), last;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        ArenaStep const& s = steps[k];
        Json const now{static_cast<int>(s.carrying), static_cast<int>(s.door_open), static_cast<int>(s.switch_on),
                       s.balls_mask, s.collected};
        if (now == last) continue;
        last = now;
        events.push_back(now);
        events.back().insert(events.back().begin(), k);
    }
    return events.dump();
}

}   // namespace lore
