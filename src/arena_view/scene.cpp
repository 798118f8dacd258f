#include <lore/arena_view/scene.h>

#include <lore/collectball/arena.h>
#include <lore/core/shortest_digits.h>

#include <stdexcept>

#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

Json pair(Point const& p) { return {shortest_digits(p.x), shortest_digits(p.y)}; }
Json corners(Rect const& r) {
    return {shortest_digits(r.x0), shortest_digits(r.x1), shortest_digits(r.y0), shortest_digits(r.y1)};
}

template <class Items, class Function>
Json list(Items const& items, Function const& text) {
    Json array = Json::array();
    for (auto const& item : items) array.push_back(text(item));
    return array;
}

Point point_of(Json const& json) { return {json.at(0), json.at(1)}; }
Rect rect_of(Json const& json) { return {json.at(0), json.at(1), json.at(2), json.at(3)}; }

}   // namespace

ArenaScene scene_of(Arena const& arena) {
    return {.width = arena.width,
            .height = arena.height,
            .walls = arena.walls,
            .doors = arena.doors,
            .ball_positions = arena.task.ball_positions,
            .balls_at_start = arena.task.ball_rule == BallRule::all_at_start,
            .basket_center = arena.basket_center,
            .basket_radius = arena.basket_radius,
            .basket_lights = arena.basket_lights,
            .switch_position = arena.switch_position,
            .robot_radius = arena.robot.radius};
}

std::string to_json(ArenaScene const& scene) {
    Json const json{{"width", shortest_digits(scene.width)},
                    {"height", shortest_digits(scene.height)},
                    {"walls", list(scene.walls, corners)},
                    {"doors", list(scene.doors, corners)},
                    {"balls", list(scene.ball_positions, pair)},
                    {"balls_at_start", scene.balls_at_start},
                    {"basket",
                     {shortest_digits(scene.basket_center.x), shortest_digits(scene.basket_center.y),
                      shortest_digits(scene.basket_radius)}},
                    {"basket_lights", list(scene.basket_lights, pair)},
                    {"switch", pair(scene.switch_position)},
                    {"robot_radius", shortest_digits(scene.robot_radius)}};
    return json.dump();
}

ArenaScene parse_arena_scene(std::string_view text) {
    Json const json = Json::parse(text);
    ArenaScene scene;
    scene.width = json.at("width");
    scene.height = json.at("height");
    for (Json const& wall : json.at("walls")) scene.walls.push_back(rect_of(wall));
    for (Json const& door : json.at("doors")) scene.doors.push_back(rect_of(door));
    for (Json const& ball : json.at("balls")) scene.ball_positions.push_back(point_of(ball));
    scene.balls_at_start = json.at("balls_at_start");
    scene.basket_center = point_of(json.at("basket"));
    scene.basket_radius = json.at("basket").at(2);
    for (Json const& light : json.at("basket_lights")) scene.basket_lights.push_back(point_of(light));
    scene.switch_position = point_of(json.at("switch"));
    scene.robot_radius = json.at("robot_radius");
    if (!(scene.width > 0 && scene.height > 0)) throw std::invalid_argument{"an arena without extent"};
    if (scene.basket_lights.empty()) throw std::invalid_argument{"a basket without lights"};
    return scene;
}

}   // namespace lore
