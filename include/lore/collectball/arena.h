#pragma once

#include <lore/collectball/shapes.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

struct Geometry;

/// The robot's body and its senses (paper, "Robot, environment and goal-oriented fitness").
struct RobotConfig {
    float radius = 20.0f;               ///< [u]
    float wheel_distance = 40.0f;       ///< [u]
    float max_speed = 4.0f;             ///< largest displacement of a wheel [u/step]
    float sensor_range = 320.0f;        ///< of the range sensors [u]
    float field_of_view = 1.5807964f;   ///< of each light sensor, full angle [rad]: pi/2 + 0.01
};

enum class DoorRule : std::uint8_t { opens_with_switch, absent };
enum class BallRule : std::uint8_t { all_at_start, one_per_press };

/// What differs between the source task and the target task; data, not code.
struct TaskRules {
    std::string name = "source";
    DoorRule door = DoorRule::opens_with_switch;
    BallRule ball_rule = BallRule::all_at_start;
    int switch_pause = 0;   ///< steps until a pressed switch is lit again; 0: never
    std::vector<Point> ball_positions;
};

/// Everything of the world that never changes during an evaluation; immutable once made.
///
/// At most 16 balls and 15 basket lights, so that one bit a light, the switch included, fits a word of 32.
struct Arena {
    std::string name;
    float width = 0, height = 0;   ///< [u]
    std::vector<Rect> walls;       ///< without the door
    std::vector<Rect> doors;       ///< parts of one door, all open or all shut; or none
    std::vector<Point> basket_lights;
    Point basket_center;
    float basket_radius = 0;   ///< a release within it scores [u]
    Point switch_position;
    float reach = 20.0f;   ///< a ball or the switch nearer than this is taken or pressed [u]
    Pose start;
    RobotConfig robot;
    TaskRules task;
    std::shared_ptr<Geometry const> geometry;   ///< the above, compiled for simulation (collectball/geometry.h)
};

inline constexpr int most_balls = 16;
inline constexpr int most_basket_lights = 15;

/// Reads an arena file (docs/manual/formats.md) and takes one of its tasks. `file` is a path, or the name of a built-in
/// arena
/// ("collectball", the text of jobs/tasks/arenas/collectball.toml).
/// Throws UsageError: unreadable, unknown key, arena not closed, a start pose, ball, switch or light inside a wall,
/// sensors or effectors that the controller cannot serve, a robot too fast for its size, no such task.
Arena load_arena(std::string const& file, std::string const& task);
/// Whether that is the name of a built-in arena, which comes before a file of that name.
bool is_builtin_arena(std::string_view name);
/// The text that load_arena would parse, for keeping a copy beside a run's results.
std::string arena_text(std::string const& file);
/// The same from text; `name` is what errors call it.
Arena parse_arena(std::string_view text, std::string const& name, std::string const& task);

}   // namespace lore
