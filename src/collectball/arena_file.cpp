#include <lore/collectball/arena.h>

#include <lore/collectball/geometry.h>
#include <lore/collectball/channels.h>
#include <lore/core/error.h>
#include <lore/core/input_file.h>
#include <lore/core/toml.h>

#include "builtin_arenas.h"
#include "validation.h"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

constexpr double largest_size = 10000.0;    ///< of an arena [u]; float32 still resolves 1e-3 u there
constexpr double largest_pause = 30000.0;   ///< fits WorldState::switch_timer

float radians(double degrees) { return static_cast<float>(degrees * (std::numbers::pi / 180.0)); }

Point to_point(std::array<double, 2> const& pair) { return {static_cast<float>(pair[0]), static_cast<float>(pair[1])}; }

Point read_point(TomlTable const& table, std::string_view key) {
    std::vector<double> const pair = table.required_numbers(key, 2);
    return to_point({pair[0], pair[1]});
}

std::vector<Point> read_points(TomlTable const& table, std::string_view key, std::size_t most) {
    std::vector<Point> points;
    for (std::array<double, 2> const& pair : table.required_pairs(key)) points.push_back(to_point(pair));
    if (points.empty() || points.size() > most)
        table.fail(key, fmt::format("1 to {} points are expected, not {}", most, points.size()));
    return points;
}

std::vector<Rect> read_walls(TomlTable const& table, std::string_view key, float width, float height) {
    std::vector<Rect> walls;
    for (TomlTable const& entry : table.tables(key)) {
        entry.string("name");   // for people
        std::vector<double> const x = entry.required_numbers("x", 2), y = entry.required_numbers("y", 2);
        entry.reject_unknown();
        Rect const wall{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(y[0]),
                        static_cast<float>(y[1])};
        if (!(wall.x0 < wall.x1)) entry.fail("x", "the first bound is not below the second");
        if (!(wall.y0 < wall.y1)) entry.fail("y", "the first bound is not below the second");
        if (wall.x0 < 0 || wall.x1 > width) entry.fail("x", fmt::format("outside the arena's 0 .. {}", width));
        if (wall.y0 < 0 || wall.y1 > height) entry.fail("y", fmt::format("outside the arena's 0 .. {}", height));
        walls.push_back(wall);
    }
    return walls;
}

/// The sensorimotor interface is fixed: a controller has one neuron for each channel, in this order. The file lists it
/// so that an arena made for other senses is refused rather than misread.
void check_channels(TomlTable const& robot, std::string_view key, std::span<std::string_view const> known) {
    auto const listed = robot.strings(key);
    if (!listed)
        robot.fail(key, "the key is missing", fmt::format("Add: {} = [\"{}\"]", key, fmt::join(known, "\", \"")));
    for (std::size_t i = 0; i < listed->size(); ++i) {
        std::string const& word = (*listed)[i];
        if (std::find(known.begin(), known.end(), word) == known.end()) {
            std::string const meant = nearest_word(word, known.data(), known.size());
            robot.fail(key, fmt::format("the controller has no '{}'", word),
                       meant.empty() ? fmt::format("It serves: {}.", fmt::join(known, ", "))
                                     : fmt::format("Did you mean '{}'?", meant));
        }
        if (i >= known.size() || word != known[i])
            robot.fail(key, fmt::format("'{}' is number {} of the list", word, i + 1),
                       fmt::format("The controller serves them in this order: {}.", fmt::join(known, ", ")));
    }
    if (listed->size() < known.size())
        robot.fail(key, fmt::format("'{}' is missing", known[listed->size()]),
                   fmt::format("The controller serves all of: {}.", fmt::join(known, ", ")));
}

RobotConfig read_robot(TomlTable const& table) {
    RobotConfig robot;
    robot.radius = static_cast<float>(table.required_number("radius", 0.1, largest_size));
    robot.wheel_distance = static_cast<float>(table.required_number("wheel_distance", 0.1, largest_size));
    robot.max_speed = static_cast<float>(table.required_number("max_speed", 1e-3, largest_size));
    robot.sensor_range = static_cast<float>(table.required_number("sensor_range", 0.1, 2 * largest_size));
    robot.field_of_view = radians(table.required_number("field_of_view_degrees", 1.0, 179.0));
    check_channels(table, "sensors", std::span{channel_names}.first(sensor_count));
    check_channels(table, "effectors", std::span{channel_names}.last(effector_count));
    table.reject_unknown();
    if (2.0 * robot.max_speed > most_turn_per_step * robot.wheel_distance)
        table.fail("max_speed", fmt::format("the robot could turn by more than {} rad in a step", most_turn_per_step),
                   "Lower max_speed or raise wheel_distance.");
    if (robot.max_speed >= robot.radius)
        table.fail("max_speed", "the robot could jump through a thin wall in one step", "Keep it below the radius.");
    return robot;
}

/// One of several words, as an index.
std::size_t read_word(TomlTable const& table, std::string_view key, std::span<std::string_view const> words) {
    std::string const word = table.required_string(key);
    auto const found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
        std::string const meant = nearest_word(word, words.data(), words.size());
        table.fail(key, fmt::format("'{}' is not one of: {}", word, fmt::join(words, ", ")),
                   meant.empty() ? "Choose one of them." : fmt::format("Did you mean '{}'?", meant));
    }
    return static_cast<std::size_t>(found - words.begin());
}

TaskRules read_task(TomlTable const& table, std::string const& name) {
    static constexpr std::string_view door_rules[] = {"opens_with_switch", "absent"};
    static constexpr std::string_view ball_rules[] = {"all_at_start", "one_per_press"};
    TaskRules task;
    task.name = name;
    task.door = static_cast<DoorRule>(read_word(table, "door", door_rules));
    task.ball_rule = static_cast<BallRule>(read_word(table, "balls", ball_rules));
    task.switch_pause =
        static_cast<int>(table.integer("switch_pause", 0, static_cast<std::int64_t>(largest_pause)).value_or(0));
    task.ball_positions = read_points(table, "positions", most_balls);
    table.reject_unknown();
    return task;
}

/// All tasks of the file, so that a mistake in one is not found only on the day that it is run.
std::vector<TaskRules> read_tasks(TomlTable const& table) {
    TomlTable const tasks = table.required_table("task");
    std::vector<TaskRules> all;
    for (std::string const& name : tasks.keys()) all.push_back(read_task(tasks.required_table(name), name));
    if (all.empty()) table.fail("task", "there is no task", "Add a table such as [task.source].");
    return all;
}

TaskRules const& find_task(std::vector<TaskRules> const& tasks, std::string const& name, std::string const& file) {
    std::vector<std::string_view> names;
    for (TaskRules const& task : tasks) {
        if (task.name == name) return task;
        names.push_back(task.name);
    }
    std::string const meant = nearest_word(name, names.data(), names.size());
    throw UsageError(fmt::format("arena {} has no task '{}'", file, name),
                     fmt::format("its tasks are: {}", fmt::join(names, ", ")),
                     meant.empty() ? "Choose one of them." : fmt::format("Did you mean '{}'?", meant));
}

}   // namespace

Arena parse_arena(std::string_view text, std::string const& name, std::string const& task) {
    TomlTable const file = TomlTable::parse(text, name);
    Arena arena;
    arena.name = file.required_string("name");
    std::vector<double> const size = file.required_numbers("size", 2);
    for (double const edge : size)
        if (!(edge >= 1.0 && edge <= largest_size))
            file.fail("size", fmt::format("{} is outside 1 .. {}", edge, largest_size));
    arena.width = static_cast<float>(size[0]);
    arena.height = static_cast<float>(size[1]);
    arena.reach = static_cast<float>(file.required_number("reach", 0.1, largest_size));
    arena.switch_position = read_point(file, "switch");
    arena.walls = read_walls(file, "walls", arena.width, arena.height);
    std::vector<Rect> const doors = read_walls(file, "door", arena.width, arena.height);

    TomlTable const start = file.required_table("start");
    Point const position = read_point(start, "position");
    arena.start = {position.x, position.y, radians(start.required_number("heading_degrees", -180.0, 180.0))};
    start.reject_unknown();

    TomlTable const basket = file.required_table("basket");
    arena.basket_lights = read_points(basket, "lights", most_basket_lights);
    arena.basket_center = read_point(basket, "centre");
    arena.basket_radius = static_cast<float>(basket.required_number("radius", 0.1, largest_size));
    basket.reject_unknown();

    arena.robot = read_robot(file.required_table("robot"));
    std::vector<TaskRules> const tasks = read_tasks(file);
    file.reject_unknown();

    for (TaskRules const& rules : tasks) {
        arena.task = rules;
        arena.doors = rules.door == DoorRule::absent ? std::vector<Rect>{} : doors;
        if (std::string const wrong = why_unusable(arena); !wrong.empty())
            throw UsageError(fmt::format("cannot use arena {} for task '{}'", name, rules.name), wrong,
                             "Mend the arena file.");
    }
    arena.task = find_task(tasks, task, name);
    arena.doors = arena.task.door == DoorRule::absent ? std::vector<Rect>{} : doors;
    compile_geometry(arena);
    return arena;
}

bool is_builtin_arena(std::string_view name) {
    auto const arenas = builtin_arenas();
    return std::any_of(arenas.begin(), arenas.end(), [&](BuiltinArena const& arena) { return arena.name == name; });
}

std::string arena_text(std::string const& file) {
    std::vector<std::string_view> names;
    for (BuiltinArena const& arena : builtin_arenas()) {
        if (arena.name == file) return std::string{arena.text};
        names.push_back(arena.name);
    }
    try {
        return read_text(current_path(file));
    } catch (UsageError const& error) {
        if (std::error_code ignored; std::filesystem::exists(file, ignored)) throw;
        std::string const meant = nearest_word(file, names.data(), names.size());
        throw UsageError(fmt::format("cannot read arena {}", file), "no such file, and no built-in arena of that name",
                         meant.empty() ? fmt::format("Give the path of an arena file, or: {}.", fmt::join(names, ", "))
                                       : fmt::format("Did you mean '{}'?", meant));
    }
}

Arena load_arena(std::string const& file, std::string const& task) { return parse_arena(arena_text(file), file, task); }

}   // namespace lore
