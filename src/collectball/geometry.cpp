#include <lore/collectball/geometry.h>

#include <lore/collectball/mechanics.h>

#include <bit>
#include <cassert>
#include <limits>

namespace lore {

namespace {

constexpr float no_face = std::numeric_limits<float>::infinity();

/// One face of a wall; `upward` if rays that run up the axis hit it.
struct Face {
    float at, lo, hi;
    bool upward, door;
};

/// A wall seen along one axis: thickness [near, far] across the faces, extent [lo, hi] along them.
struct Slab {
    float near, far, lo, hi;
};

Slab across_x(Rect const& r) { return {r.x0, r.x1, r.y0, r.y1}; }
Slab across_y(Rect const& r) { return {r.y0, r.y1, r.x0, r.x1}; }

/// True if everything just in front of the face is inside the wall `cover`.
bool covers(Slab const& cover, Face const& face) {
    bool const along = cover.lo <= face.lo && face.hi <= cover.hi;
    return along &&
           (face.upward ? cover.near < face.at && face.at <= cover.far : cover.near <= face.at && face.at < cover.far);
}

/// Faces across one axis, joined in pairs of the same interval so that a ray needs one test for two.
std::vector<FacePair> faces_across(Slab (*slab_of)(Rect const&), float size, std::vector<Rect> const& walls,
                                   int first_door) {
    std::vector<FacePair> pairs;
    for (int i = 0; i < static_cast<int>(walls.size()); ++i) {
        Slab const slab = slab_of(walls[static_cast<std::size_t>(i)]);
        bool const door = i >= first_door;
        for (Face const& face :
             {Face{slab.near, slab.lo, slab.hi, true, door}, Face{slab.far, slab.lo, slab.hi, false, door}}) {
            bool unreachable = face.at <= 0.0f || face.at >= size;
            for (int k = 0; k < first_door && !unreachable; ++k)
                unreachable = k != i && covers(slab_of(walls[static_cast<std::size_t>(k)]), face);
            if (unreachable) continue;
            bool joined = false;
            for (FacePair& pair : pairs) {
                float& place = face.upward ? pair.upward : pair.downward;
                if (joined || place != no_face || pair.lo != face.lo || pair.hi != face.hi || pair.door != door)
                    continue;
                place = face.at;
                joined = true;
            }
            if (!joined)
                pairs.push_back(
                    {face.upward ? face.at : no_face, face.upward ? no_face : face.at, face.lo, face.hi, door});
        }
    }
    return pairs;
}

}   // namespace

void compile_geometry(Arena& arena) {
    assert(arena.task.ball_positions.size() <= most_balls && arena.basket_lights.size() <= most_basket_lights);
    auto geometry = std::make_shared<Geometry>();
    Geometry& g = *geometry;
    g.walls = arena.walls;
    g.first_door = static_cast<int>(arena.walls.size());
    g.walls.insert(g.walls.end(), arena.doors.begin(), arena.doors.end());
    g.vertical = faces_across(across_x, arena.width, g.walls, g.first_door);
    g.horizontal = faces_across(across_y, arena.height, g.walls, g.first_door);

    g.lights = arena.task.ball_positions;
    for (Point const& light : arena.basket_lights) {
        g.basket_mask |= 1u << g.lights.size();
        g.lights.push_back(light);
    }
    g.switch_mask = 1u << g.lights.size();
    g.lights.push_back(arena.switch_position);

    RobotConfig const& robot = arena.robot;
    g.width = arena.width;
    g.height = arena.height;
    g.touch_distance = robot.radius + robot.max_speed;
    g.radius_squared = robot.radius * robot.radius;
    g.reach_squared = arena.reach * arena.reach;
    g.basket_radius_squared = arena.basket_radius * arena.basket_radius;
    g.inverse_wheel_distance = 1.0f / robot.wheel_distance;
    g.inverse_range = 1.0f / robot.sensor_range;
    float const cosine = math::sincos(robot.field_of_view * 0.5f).cos;
    g.cos_squared_half_view = cosine * cosine;
    arena.geometry = std::move(geometry);
}

Surroundings const& Geometry::surroundings() const {
    std::call_once(surveyed_,
                   [this] { surroundings_ = survey(width, height, walls, first_door, lights, touch_distance); });
    return surroundings_;
}

namespace {

int walls_standing(Geometry const& g, bool door_open) {
    return door_open ? g.first_door : static_cast<int>(g.walls.size());
}

}   // namespace

bool light_visible(Geometry const& g, int light, float x, float y, bool door_open) {
    Point const& at = g.lights[static_cast<std::size_t>(light)];
    std::size_t const walls = door_open ? static_cast<std::size_t>(g.first_door) : g.walls.size();
    for (std::size_t i = 0; i < walls; ++i)
        if (mechanics::segment_meets(g.walls[i], x, y, at.x, at.y)) return false;
    return true;
}

std::uint32_t visible_lights(Geometry const& g, std::uint32_t wanted, float x, float y, bool door_open) {
    Surroundings::Cell const cell = g.surroundings().at(x, y, door_open);
    std::uint32_t visible = wanted & (cell.clear_lights() | cell.mixed_lights());
    for (std::uint32_t doubtful = wanted & cell.mixed_lights(); doubtful != 0; doubtful &= doubtful - 1) {
        int const light = std::countr_zero(doubtful);
        Point const& at = g.lights[static_cast<std::size_t>(light)];
        visit_walls(cell.suspects, walls_standing(g, door_open), [&](int wall) {
            if (mechanics::segment_meets(g.walls[static_cast<std::size_t>(wall)], x, y, at.x, at.y))
                visible &= ~(1u << light);
        });
    }
    return visible;
}

float cast_ray(Geometry const& g, float x, float y, float dx, float dy, bool door_open) {
    mechanics::Ray<float> const ray = mechanics::ray(mechanics::Vector<float>{dx, dy});
    float nearest = std::numeric_limits<float>::infinity();
    for (FacePair const& face : g.vertical)
        if (!(face.door && door_open)) nearest = mechanics::hit_vertical(face, x, y, ray, nearest);
    for (FacePair const& face : g.horizontal)
        if (!(face.door && door_open)) nearest = mechanics::hit_horizontal(face, x, y, ray, nearest);
    return nearest;
}

bool disc_touches(Geometry const& g, float x, float y, bool door_open) {
    std::size_t const walls = door_open ? static_cast<std::size_t>(g.first_door) : g.walls.size();
    bool touched = false;
    for (std::size_t i = 0; i < walls; ++i) touched |= mechanics::touches(g.walls[i], x, y, g.radius_squared);
    return touched;
}

}   // namespace lore
