#pragma once

#include <lore/collectball/shapes.h>
#include <lore/collectball/channels.h>
#include <lore/core/isa.h>
#include <lore/episode/lane_buffers.h>

#include <cstdint>

/// What the lane kernels read and write: plain structs of pointers and arrays, because kernels may not include the
/// standard containers (tools/cmake/LoreTargets.cmake, lore_kernel).
namespace lore {

/// An interval [lo, hi] of a face line; `door`: there only while the door is shut.
struct FaceInterval {
    float lo, hi;
    std::int32_t door;
};

/// Face pairs in the same two places: one distance serves all their intervals (FacePair, collectball/shapes.h).
struct FaceLine {
    float upward, downward;
    std::int32_t first, last;   ///< in the intervals
};

/// A light; its bit is read from memory, where broadcasting costs nothing.
struct LaneLight {
    float x, y;
    std::int32_t bit;
};

/// Geometry, robot and task as the kernel reads them.
struct LaneArena {
    FaceLine const* vertical;
    FaceLine const* horizontal;
    std::int32_t vertical_count, horizontal_count;
    FaceInterval const* intervals;
    Rect const* walls;
    std::int32_t wall_count, first_door;
    LaneLight const* lights;
    std::int32_t light_count;
    std::uint32_t ball_mask, basket_mask, switch_mask;   ///< of lights

    void const* cells;   ///< Surroundings::cells
    std::int32_t columns, rows, open_offset;
    float cells_per_u;
    /// Lights to look at wherever a lane is. A robot is never nearer to a wall than its radius, so no wall comes
    /// between it and a ball within a reach that is no longer: hidden lights can be passed over, else the balls and the
    /// lamp not.
    std::uint32_t always_asked;

    float radius, radius_squared, reach_squared, max_speed, inverse_wheel_distance, sensor_range, inverse_range;
    float cos_squared_half_view;
    std::int32_t switch_pause;
};

/// Lanes of the widest kernel; narrower ones use the first of them.
inline constexpr int lane_slots = 16 * lane_vectors;

/// All that changes while the lanes run, and where they record. Arrays are [lane].
struct alignas(64) LaneWork {
    float x[lane_slots], y[lane_slots], theta[lane_slots];
    std::int32_t bumper_right[lane_slots], bumper_left[lane_slots];   ///< masks: 0 or -1, likewise below
    std::int32_t carrying[lane_slots], door_open[lane_slots], switch_lit[lane_slots];
    std::int32_t balls_mask[lane_slots];   ///< WorldState::balls_mask
    std::int32_t switch_timer[lane_slots];
    std::int32_t still_steps[lane_slots];   ///< of the life; counted where `stop_when_still` is not 0

    /// Within a step: heading, the word so far, whether something can be taken or pressed, walls that may be touched.
    float heading_sin[lane_slots], heading_cos[lane_slots];
    float theta_before[lane_slots];   ///< where still steps are counted
    std::int32_t word[lane_slots], in_reach[lane_slots];
    std::uint32_t touchable[lane_vectors];

    int step;              ///< row of the chunk, for `act`
    int stop_when_still;   ///< CollectballWorld's
    LaneArena arena;
    LaneBuffers buffers;

    /// Called where a lane's robot picks up, releases or presses: applies the rules to the lane's world and writes back
    /// carrying, door_open, switch_lit, balls_mask and switch_timer. Those are as before the step's action.
    void (*act)(LaneWork&, int lane, float collect);
    void* owner;   ///< for `act`
};

/// Steps all lanes, rows `first` to `last` - 1 of the chunk. Returns `last`, or the row after that in which some lane
/// came to more still steps than stop_when_still.
LORE_KERNEL(int run_steps(LaneWork&, int first, int last))

}   // namespace lore
