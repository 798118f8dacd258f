#include <lore/campaign/replay.h>

#include <lore/archive/atomic_file.h>
#include <lore/core/csv.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>
#include <lore/core/shortest_digits.h>
#include <lore/core/whole_number.h>
#include <lore/knowledge/window.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view remedy = "Remove scene.json and make it again with 'lore-campaign replay'.";

template <class Items, class Function>
Json list(Items const& items, Function const& text) {
    Json array = Json::array();
    for (auto const& item : items) array.push_back(text(item));
    return array;
}

Scene read_scene(Json const& json) {
    Scene scene{json.at("width"), json.at("height"), svg_or_nothing(json.at("svg"))};
    if (!(scene.width > 0 && scene.height > 0)) throw std::invalid_argument{"a world without extent"};
    return scene;
}

std::string arenas_text(std::vector<Replay> const& replays) {
    std::string text = "replay,step,x,y,theta,carrying,door_open,switch_on,balls_mask,collected\n";
    for (Replay const& replay : replays)
        for (std::size_t k = 0; k < replay.steps.size(); ++k) {
            ReplayStep const& at = replay.steps[k];
            ArenaStep const& s = replay.arena->steps[k];
            fmt::format_to(std::back_inserter(text), "{},{},{:.2f},{:.2f},{:.3f},{:d},{:d},{:d},{},{}\n", replay.run, k,
                           at.x, at.y, s.theta, s.carrying, s.door_open, s.switch_on, s.balls_mask, s.collected);
        }
    return text;
}

std::string replay_text(std::vector<Replay> const& replays) {
    if (all_in_arenas(replays)) return arenas_text(replays);
    std::string text = "replay,step,x,y,reward\n";
    for (Replay const& replay : replays)
        for (std::size_t k = 0; k < replay.steps.size(); ++k) {
            ReplayStep const& at = replay.steps[k];
            fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.6g}\n", replay.run, k, at.x, at.y, at.reward);
        }
    return text;
}

/// Balls need no more than four decimals; a value of another unit may be smaller than these.
std::string values_text(std::vector<PanelValues> const& panels, bool arenas) {
    auto const value_text = [=](double value) {
        return std::isnan(value) ? std::string{} : arenas ? fmt::format("{:.4f}", value) : fmt::format("{}", value);
    };
    std::string text = "figure,knowledge,window,value\n";
    for (PanelValues const& panel : panels)
        for (std::size_t w = 0; w < panel.values.size(); ++w)
            fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", panel.figure, panel.knowledge, w,
                           value_text(panel.values[w]));
    return text;
}

Json json_of(Replay const& replay, bool arena) {
    Json json{{"run", replay.run}, {"signature", replay.signature}};
    if (arena) {
        json["scene"] = Json::parse(to_json(replay.arena->scene));
    } else {
        json["reward_unit"] = replay.reward_unit;
        json["world"] = {{"width", shortest_digits(replay.scene.width)},
                         {"height", shortest_digits(replay.scene.height)},
                         {"svg", replay.scene.svg}};
    }
    return json;
}

Replay replay_of(Json const& json) {
    Replay replay{json.at("run"), json.at("signature"), std::string{first_reward_unit}, {}, {}, {}};
    if (json.contains("world")) {
        replay.reward_unit = json.at("reward_unit");
        replay.scene = read_scene(json.at("world"));
    } else {
        replay.arena = ArenaReplay{parse_arena_scene(json.at("scene").dump()), {}};
        replay.scene.width = replay.arena->scene.width;
        replay.scene.height = replay.arena->scene.height;
    }
    return replay;
}

/// One line a replay: small, and a difference between two files is legible.
std::string scenes_text(Replays const& all) {
    bool const arenas = all_in_arenas(all.replays);
    std::string text = "{\"replays\": [";
    for (Replay const& replay : all.replays)
        text += fmt::format("{}\n{}", &replay == all.replays.data() ? "" : ",",
                            json_of(replay, arenas).dump(-1, ' ', false, Json::error_handler_t::replace));
    Json const panels = list(all.panels, [](PanelValues const& panel) {
        Json json{{"figure", panel.figure}, {"knowledge", panel.knowledge}, {"checksum", panel.checksum}};
        if (panel.window_length > 0) json["window_length"] = panel.window_length;
        return json;
    });
    return text + fmt::format("],\n\"panels\": {}}}\n", panels.dump());
}

/// Reads the columns that an arena has besides positions.
class ArenaColumns {
public:
    explicit ArenaColumns(CsvTable const& table)
        : table_(table), theta_(table.column("theta")), carrying_(table.column("carrying")),
          door_open_(table.column("door_open")), switch_on_(table.column("switch_on")),
          balls_mask_(table.column("balls_mask")), collected_(table.column("collected")) {}

    ArenaStep step(std::size_t r) const {
        return {table_.number<float>(r, theta_),         table_.number(r, carrying_, 0, 1) != 0,
                table_.number(r, door_open_, 0, 1) != 0, table_.number(r, switch_on_, 0, 1) != 0,
                table_.number<unsigned>(r, balls_mask_), table_.number<int>(r, collected_)};
    }

private:
    CsvTable const& table_;
    std::size_t theta_, carrying_, door_open_, switch_on_, balls_mask_, collected_;
};

void read_steps(std::string const& path, std::vector<Replay>& replays) {
    CsvTable const table = CsvTable::read(path, remedy);
    std::size_t const name = table.column("replay"), x = table.column("x"), y = table.column("y");
    std::optional<ArenaColumns> arena;
    if (all_in_arenas(replays)) arena.emplace(table);
    std::size_t const reward = arena ? 0 : table.column("reward");
    for (std::size_t r = 0; r < table.rows(); ++r) {
        auto const replay = std::find_if(replays.begin(), replays.end(),
                                         [&](Replay const& entry) { return entry.run == table.text(r, name); });
        if (replay == replays.end())
            table.refuse(r, name, fmt::format("scene.json does not know '{}'", table.text(r, name).substr(0, 40)));
        if (arena) replay->arena->steps.push_back(arena->step(r));
        replay->steps.push_back(
            {table.number<float>(r, x), table.number<float>(r, y),
             arena ? static_cast<double>(replay->arena->steps.back().collected) : table.number<double>(r, reward)});
    }
    for (Replay const& replay : replays)
        if (replay.steps.empty()) table.refuse(fmt::format("it has no step of '{}'", replay.run));
}

PanelValues panel_of(Json const& json) {
    PanelValues panel{json.at("figure"), json.at("knowledge"), {}, json.at("checksum"), json.value("window_length", 0)};
    if (json.contains("window_length") && panel.window_length < 1)
        throw std::invalid_argument{"a window without length"};
    return panel;
}

/// Files made before 1.0.0 do not say the length of windows. So many whole ones fit where the length is the usual one,
/// or else the longest of those with which they do.
int fitting_length(std::size_t steps, std::size_t windows) {
    KnowledgeConfig const usual;
    auto const length = static_cast<std::size_t>(usual.window_length);
    if (windows == 0 || steps / length == windows) return usual.window_length;
    return static_cast<int>(std::max<std::size_t>(1, steps / windows));
}

/// Nor have those of arenas an empty field for a window that is not found: they have -1, and 0 of a product.
void mark_not_found(PanelValues& panel) {
    double const not_found = panel.knowledge.find('*') != std::string::npos ? 0 : -1;
    std::replace(panel.values.begin(), panel.values.end(), not_found, std::numeric_limits<double>::quiet_NaN());
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
        panel->values.push_back(table.text(r, value).empty() ? std::numeric_limits<double>::quiet_NaN()
                                                             : table.number<double>(r, value));
    }
}

}   // namespace

bool all_in_arenas(std::vector<Replay> const& replays) {
    return std::all_of(replays.begin(), replays.end(), [](Replay const& replay) { return replay.arena.has_value(); });
}

void write_replays(CampaignDirectory const& directory, Replays const& all) {
    std::error_code failed;
    std::filesystem::create_directories(directory.path(), failed);
    if (failed)
        throw Error(fmt::format("cannot make the directory {}", directory.path()), failed.message(),
                    "Choose another with --out.");
    write_file_atomically(directory.file("replay.csv"), std::string_view{replay_text(all.replays)});
    write_file_atomically(directory.file("values.csv"),
                          std::string_view{values_text(all.panels, all_in_arenas(all.replays))});
    write_file_atomically(directory.file("scene.json"), std::string_view{scenes_text(all)});
}

Replays read_scenes(CampaignDirectory const& directory) {
    std::string const path = directory.file("scene.json");
    Replays all;
    if (!is_there(path)) return all;
    try {
        Json const document = Json::parse(read_text(path), refuse_deep_nesting<Json>);
        for (Json const& entry : document.at("replays")) all.replays.push_back(replay_of(entry));
        for (Json const& entry : document.at("panels")) all.panels.push_back(panel_of(entry));
    } catch (std::exception const& error) { throw Error(fmt::format("cannot read {}", path), error.what(), remedy); }
    return all;
}

Replays read_replays(CampaignDirectory const& directory) {
    Replays all = read_scenes(directory);
    if (all.replays.empty()) return all;
    read_steps(directory.file("replay.csv"), all.replays);
    read_values(directory.file("values.csv"), all.panels);
    std::size_t const steps = all.replays.front().steps.size();
    for (PanelValues& panel : all.panels) {
        if (panel.window_length == 0) {
            panel.window_length = fitting_length(steps, panel.values.size());
            if (all_in_arenas(all.replays)) mark_not_found(panel);
        } else if (panel.values.size() > steps / static_cast<std::size_t>(panel.window_length)) {
            throw Error(fmt::format("cannot read {}", directory.file("values.csv")),
                        fmt::format("{} windows of {} steps are more than the {} steps of {}", panel.values.size(),
                                    panel.window_length, steps, all.replays.front().run),
                        remedy);
        }
    }
    return all;
}

}   // namespace lore
