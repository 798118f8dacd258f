#pragma once

#include <lore/collectball/arena.h>
#include <lore/collectball/surroundings.h>

#include <cstdint>
#include <mutex>
#include <vector>

namespace lore {

/// An Arena compiled for simulation: what the inner loop reads, derived once, immutable.
struct Geometry {
    std::vector<FacePair> vertical, horizontal;   ///< what a ray can hit first; faces hidden for good are left out
    std::vector<Rect> walls;                      ///< what a disc can touch; the door's parts last
    int first_door = 0;                           ///< index in `walls`

    /// Balls, then basket lights, then the switch; bit i of every light mask is lights[i].
    std::vector<Point> lights;
    std::uint32_t basket_mask = 0, switch_mask = 0;   ///< balls are the low bits, as in WorldState::balls_mask
    float radius_squared = 0, reach_squared = 0, basket_radius_squared = 0;   ///< [u^2]
    float inverse_wheel_distance = 0;                                         ///< [1/u]
    float inverse_range = 0;                                                  ///< of the range sensors [1/u]
    float cos_squared_half_view = 0;                                          ///< of the light sensors

    /// What a robot can see and touch from each cell. Worked out when it is first asked for: that takes 10 ms, and most
    /// who open an arena simulate nothing in it.
    Surroundings const& surroundings() const;

    float width = 0, height = 0, touch_distance = 0;   ///< what survey() asks for [u]

private:
    mutable std::once_flag surveyed_;
    mutable Surroundings surroundings_;
};

/// Fills in Arena::geometry; to be called again after any change of the other members. parse_arena has done it.
void compile_geometry(Arena&);

/// True if no wall, nor the shut door, crosses the segment from the light to (x, y): the definition.
bool light_visible(Geometry const&, int light, float x, float y, bool door_open);
/// The same for all lights in `wanted` at once, through the table of surroundings.
std::uint32_t visible_lights(Geometry const&, std::uint32_t wanted, float x, float y, bool door_open);

/// Distance from (x, y) to the first wall in the direction of the unit vector (dx, dy) [u], infinity if there is none.
float cast_ray(Geometry const&, float x, float y, float dx, float dy, bool door_open);
/// True if the robot's disc at (x, y) touches a wall or the shut door.
bool disc_touches(Geometry const&, float x, float y, bool door_open);

}   // namespace lore
