#include <lore/campaign/replay.h>

#include <lore/archive/atomic_file.h>
#include <lore/core/csv.h>
#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view remedy = "Remove scene.json and make it again with 'lore-campaign replay'.";

/// The shortest number that reads back to the same float; a double's digits would pretend to know more.
Json number(float value) { return std::stod(fmt::format("{}", value)); }
Json pair(Point const& p) { return {number(p.x), number(p.y)}; }
Json corners(Rect const& r) { return {number(r.x0), number(r.x1), number(r.y0), number(r.y1)}; }

template <class Items, class Function>
Json list(Items const& items, Function const& text) {
    Json array = Json::array();
    for (auto const& item : items) array.push_back(text(item));
    return array;
}

Json json_of(Scene const& scene) {
    return {{"width", number(scene.width)},
            {"height", number(scene.height)},
            {"walls", list(scene.walls, corners)},
            {"doors", list(scene.doors, corners)},
            {"balls", list(scene.ball_positions, pair)},
            {"balls_at_start", scene.balls_at_start},
            {"basket", {number(scene.basket_center.x), number(scene.basket_center.y), number(scene.basket_radius)}},
            {"basket_lights", list(scene.basket_lights, pair)},
            {"switch", pair(scene.switch_position)},
            {"robot_radius", number(scene.robot_radius)}};
}

Point point_of(Json const& json) { return {json.at(0), json.at(1)}; }
Rect rect_of(Json const& json) { return {json.at(0), json.at(1), json.at(2), json.at(3)}; }

Scene read_scene(Json const& json) {
    Scene scene;
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

std::string replay_text(std::vector<Replay> const& replays) {
    std::string text = "replay,step,x,y,theta,carrying,door_open,switch_on,balls_mask,collected\n";
    for (Replay const& replay : replays)
        for (std::size_t k = 0; k < replay.steps.size(); ++k) {
            ReplayStep const& s = replay.steps[k];
            fmt::format_to(std::back_inserter(text), "{},{},{:.2f},{:.2f},{:.3f},{:d},{:d},{:d},{},{}\n", replay.run, k,
                           s.x, s.y, s.theta, s.carrying, s.door_open, s.switch_on, s.balls_mask, s.collected);
        }
    return text;
}

std::string values_text(std::vector<PanelValues> const& panels) {
    std::string text = "figure,knowledge,window,value\n";
    for (PanelValues const& panel : panels)
        for (std::size_t w = 0; w < panel.values.size(); ++w)
            fmt::format_to(std::back_inserter(text), "{},{},{},{:.4f}\n", panel.figure, panel.knowledge, w,
                           panel.values[w]);
    return text;
}

/// One line a replay: small, and a difference between two files is legible.
std::string scenes_text(Replays const& all) {
    std::string text = "{\"replays\": [";
    for (Replay const& replay : all.replays)
        text += fmt::format(
            "{}\n{}", &replay == all.replays.data() ? "" : ",",
            Json{{"run", replay.run}, {"signature", replay.signature}, {"scene", json_of(replay.scene)}}.dump());
    Json const panels = list(all.panels, [](PanelValues const& panel) {
        return Json{{"figure", panel.figure}, {"knowledge", panel.knowledge}, {"checksum", panel.checksum}};
    });
    return text + fmt::format("],\n\"panels\": {}}}\n", panels.dump());
}

void read_steps(std::string const& path, std::vector<Replay>& replays) {
    CsvTable const table = CsvTable::read(path, remedy);
    std::size_t const name = table.column("replay"), x = table.column("x"), y = table.column("y"),
                      theta = table.column("theta"), carrying = table.column("carrying"),
                      door_open = table.column("door_open"), switch_on = table.column("switch_on"),
                      balls_mask = table.column("balls_mask"), collected = table.column("collected");
    for (std::size_t r = 0; r < table.rows(); ++r) {
        auto const replay = std::find_if(replays.begin(), replays.end(),
                                         [&](Replay const& entry) { return entry.run == table.text(r, name); });
        if (replay == replays.end())
            table.refuse(r, name, fmt::format("scene.json does not know '{}'", table.text(r, name).substr(0, 40)));
        replay->steps.push_back({table.number<float>(r, x), table.number<float>(r, y), table.number<float>(r, theta),
                                 table.number(r, carrying, 0, 1) != 0, table.number(r, door_open, 0, 1) != 0,
                                 table.number(r, switch_on, 0, 1) != 0, table.number<unsigned>(r, balls_mask),
                                 table.number<int>(r, collected)});
    }
    for (Replay const& replay : replays)
        if (replay.steps.empty()) table.refuse(fmt::format("it has no step of '{}'", replay.run));
}

void read_values(std::string const& path, std::vector<PanelValues>& panels) {
    CsvTable const table = CsvTable::read(path, remedy);
    std::size_t const figure = table.column("figure"), knowledge = table.column("knowledge"),
                      value = table.column("value");
    for (std::size_t r = 0; r < table.rows(); ++r) {
        auto const panel = std::find_if(panels.begin(), panels.end(), [&](PanelValues const& entry) {
            return entry.figure == table.text(r, figure) && entry.knowledge == table.text(r, knowledge);
        });
        if (panel == panels.end()) table.refuse(r, knowledge, "scene.json does not know this panel");
        panel->values.push_back(table.number<double>(r, value));
    }
}

}   // namespace

void write_replays(CampaignDirectory const& directory, Replays const& all) {
    std::error_code failed;
    std::filesystem::create_directories(directory.path(), failed);
    if (failed)
        throw Error(fmt::format("cannot make the directory {}", directory.path()), failed.message(),
                    "Choose another with --out.");
    write_file_atomically(directory.file("replay.csv"), std::string_view{replay_text(all.replays)});
    write_file_atomically(directory.file("values.csv"), std::string_view{values_text(all.panels)});
    write_file_atomically(directory.file("scene.json"), std::string_view{scenes_text(all)});
}

Replays read_scenes(CampaignDirectory const& directory) {
    std::string const path = directory.file("scene.json");
    Replays all;
    if (!std::filesystem::exists(path)) return all;
    try {
        Json const document = Json::parse(read_text(path));
        for (Json const& entry : document.at("replays"))
            all.replays.push_back({entry.at("run"), entry.at("signature"), read_scene(entry.at("scene")), {}});
        for (Json const& entry : document.at("panels"))
            all.panels.push_back({entry.at("figure"), entry.at("knowledge"), {}, entry.at("checksum")});
    } catch (std::exception const& error) { throw Error(fmt::format("cannot read {}", path), error.what(), remedy); }
    return all;
}

Replays read_replays(CampaignDirectory const& directory) {
    Replays all = read_scenes(directory);
    if (all.replays.empty()) return all;
    read_steps(directory.file("replay.csv"), all.replays);
    read_values(directory.file("values.csv"), all.panels);
    return all;
}

}   // namespace lore
