// The episode's inner loop for LORE_LANES robots at once; compiled once per instruction set (lore_kernel). Formulas are
// those of collectball/mechanics.h and core/math.h, which the plain episode uses too; here is only their arrangement.
#include "lane_work.h"
#include "stillness.h"

#include <lore/collectball/mechanics.h>
#include <lore/collectball/wall_set.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES;
constexpr int row = width * lane_vectors;   // of every array [..][lane]
using F = Lanes<float, width>;
using I = Lanes<std::int32_t, width>;
using Words = Lanes<std::uint16_t, width>;

/// The sensors of each kind, as numbers of the networks' inputs.
struct SensorNumbers {
    int continuous[continuous_sensor_count], binary[binary_count];
};
consteval SensorNumbers sensor_numbers() {
    SensorNumbers numbers{};
    for (int c = 0; c < continuous_sensor_count; ++c) numbers.continuous[c] = continuous_channels[c];
    for (int b = 0; b < binary_count; ++b) numbers.binary[b] = binary_channels[b];
    return numbers;
}
constexpr SensorNumbers sensors = sensor_numbers();
constexpr int rays = 3;

LORE_INLINE F ones_where(I const& mask) { return lanes::select(mask, lanes::all_of<F>(1.0f), F{}); }

/// Three rays against the faces of one line; what mechanics::hit_vertical and hit_horizontal say, arranged for speed:
/// a comparison costs AVX-512 twice what an addition does, so conditions are sign bits, of differences that are
/// negative where the ray passes beside the interval. Distances are kept negative: then the sign of t, too, says
/// whether the face lies ahead. (t is not 0, since the center of a robot never lies on a face.)
template <bool along_x>
LORE_INLINE void hit_line(LaneArena const& arena, FaceLine const& line, F const& across, F const& along, I const& shut,
                          mechanics::Ray<F> const (&way)[rays], F (&nearest)[rays]) {
    F const up = across - line.upward, down = across - line.downward;
    F t[rays], reach[rays];   // negative
    I beside[rays];           // negative: beside all intervals
    for (I& sign : beside) sign = lanes::all_of<I>(-1);
    for (int r = 0; r < rays; ++r) {
        F const& direction = along_x ? way[r].direction.y : way[r].direction.x;
        F const& reciprocal = along_x ? way[r].reciprocal.y : way[r].reciprocal.x;
        t[r] = lanes::select(direction > 0.0f, up, down) * reciprocal;
        reach[r] = t[r] * (along_x ? way[r].direction.x : way[r].direction.y);
    }
    for (int i = line.first; i < line.last; ++i) {
        FaceInterval const& interval = arena.intervals[i];
        F lo = along - interval.lo;
        F const hi = interval.hi - along;
        // An open door begins at infinity.
        if (interval.door) lo = lanes::select(shut, lo, lanes::all_of<F>(-__builtin_inff()));
        for (int r = 0; r < rays; ++r)
            beside[r] = lanes::and_either(beside[r], lanes::cast_bits<I>(F(lo - reach[r])),
                                          lanes::cast_bits<I>(F(hi + reach[r])));
    }
    for (int r = 0; r < rays; ++r) {
        I const hit = ~beside[r] & lanes::cast_bits<I>(t[r]);
        nearest[r] = lanes::select_negative(hit, lanes::max(t[r], nearest[r]), nearest[r]);
    }
}

/// Distances along the three rays (right, left, ahead).
LORE_INLINE void cast_rays(LaneArena const& arena, F const& x, F const& y, mechanics::Directions<F> const& look,
                           I const& shut, F (&nearest)[rays]) {
    mechanics::Ray<F> const right = mechanics::ray(look.right);
    mechanics::Ray<F> const way[rays] = {
        right, {look.left, {right.reciprocal.y, -right.reciprocal.x}}, mechanics::ray(look.ahead)};
    for (F& distance : nearest) distance = lanes::all_of<F>(-__builtin_inff());
    for (int i = 0; i < arena.vertical_count; ++i) hit_line<false>(arena, arena.vertical[i], x, y, shut, way, nearest);
    for (int i = 0; i < arena.horizontal_count; ++i)
        hit_line<true>(arena, arena.horizontal[i], y, x, shut, way, nearest);
    for (F& distance : nearest) distance = -distance;
}

/// What the cells where the robots are know (Surroundings::Cell), per lane.
struct Known {
    I clear, mixed, suspects, touchable;
};

LORE_INLINE Known look_up(LaneArena const& arena, F const& x, F const& y, I const& open) {
    // Robots cannot leave the closed arena; the bounds only keep every read inside the table.
    F const column =
        lanes::min(lanes::max(F(x * arena.cells_per_u), F{}), lanes::all_of<F>(static_cast<float>(arena.columns - 1)));
    F const line =
        lanes::min(lanes::max(F(y * arena.cells_per_u), F{}), lanes::all_of<F>(static_cast<float>(arena.rows - 1)));
    I const cell = lanes::truncate(line) * arena.columns + lanes::truncate(column) + (open & arena.open_offset);
    auto const [lights, walls] = lanes::gather_pairs(arena.cells, cell);
    return {lights & 0xffff, (lights >> 16) | ~0xffff, walls & 0xffff, walls >> 16 & 0xffff};
}

/// Lights in view of the sensors at each side, and those near enough to be taken or pressed; a bit a light.
struct LightsSeen {
    I right, left, in_reach;
};

LORE_INLINE LightsSeen see_lights(LaneArena const& arena, F const& x, F const& y, mechanics::Directions<F> const& look,
                                  Known const& known, I const& shining, I const& open) {
    I right{}, left{}, near{};
    I const possible = (known.clear | known.mixed | static_cast<std::int32_t>(arena.always_asked)) & shining;
    for (std::uint32_t asked = lanes::reduce_or(possible); asked != 0; asked &= asked - 1) {
        int const light = __builtin_ctz(asked);
        LaneLight const& at = arena.lights[light];
        F const vx = at.x - x, vy = at.y - y;
        right =
            lanes::select(mechanics::in_view(vx, vy, look.right, arena.cos_squared_half_view), right | at.bit, right);
        left = lanes::select(mechanics::in_view(vx, vy, look.left, arena.cos_squared_half_view), left | at.bit, left);
        near = lanes::select(vx * vx + vy * vy < arena.reach_squared, near | at.bit, near);
    }
    I visible = (known.clear | known.mixed) & shining;
    I const doubtful = (right | left) & known.mixed & shining;
    if (std::uint32_t asked = lanes::reduce_or(doubtful); asked != 0) {
        WallSet const suspects = static_cast<WallSet>(lanes::reduce_or(I(known.suspects & (doubtful != 0))));
        for (; asked != 0; asked &= asked - 1) {
            int const light = __builtin_ctz(asked);
            F const light_x = lanes::all_of<F>(arena.lights[light].x),
                    light_y = lanes::all_of<F>(arena.lights[light].y);
            visit_walls(
                suspects, arena.wall_count, [&](int wall) __attribute__((always_inline)) {
                    I crossed = mechanics::segment_meets(arena.walls[wall], x, y, light_x, light_y);
                    if (wall >= arena.first_door) crossed &= ~open;
                    // Where the light is clear no wall crosses, so lanes need not be told apart.
                    visible &= ~(crossed & (1 << light));
                });
        }
    }
    return {right & visible, left & visible, near & shining};
}

/// A wall of its own for every lane.
struct Walls {
    F x0{}, x1{}, y0{}, y1{};
    LORE_INLINE void take(I const& mask, Rect const& wall) {
        x0 = lanes::select(mask, lanes::all_of<F>(wall.x0), x0);
        x1 = lanes::select(mask, lanes::all_of<F>(wall.x1), x1);
        y0 = lanes::select(mask, lanes::all_of<F>(wall.y0), y0);
        y1 = lanes::select(mask, lanes::all_of<F>(wall.y1), y1);
    }
};

/// What the attempted move meets.
struct Contact {
    I any, right, left;
};

LORE_INLINE Contact touch_walls(LaneArena const& arena, WallSet touchable, F const& x, F const& y,
                                math::SinCos<F> const& heading, I const& open) {
    Contact contact{I{}, I{}, I{}};
    auto const press = [&](I const& touched, auto const& walls) __attribute__((always_inline)) {
        auto const pressed = mechanics::bumpers(walls, x, y, heading, arena.radius);
        contact.right |= pressed.right & touched;
        contact.left |= pressed.left & touched;
    };
    // A lane seldom touches more than one wall, or two in a corner, but the lanes touch different ones: all first
    // walls are judged at once, then all second ones.
    Walls first, second;
    I again{}, more{};
    visit_walls(
        touchable, arena.wall_count, [&](int i) __attribute__((always_inline)) {
            Rect const& wall = arena.walls[i];
            I touched = mechanics::touches(wall, x, y, arena.radius_squared);
            if (i >= arena.first_door) touched &= ~open;
            first.take(touched & ~contact.any, wall);
            if (I const further = touched & contact.any; lanes::any(further)) {
                second.take(further & ~again, wall);
                more |= further & again;
                again |= further;
            }
            contact.any |= touched;
        });
    if (!lanes::any(contact.any)) return contact;
    press(contact.any, first);
    if (!lanes::any(again)) return contact;
    press(again, second);
    if (!lanes::any(more)) return contact;
    visit_walls(
        touchable, arena.wall_count, [&](int i) __attribute__((always_inline)) {
            I touched = mechanics::touches(arena.walls[i], x, y, arena.radius_squared) & more;
            if (i >= arena.first_door) touched &= ~open;
            press(touched, arena.walls[i]);
        });
    return contact;
}

/// Reads the sensors of one vector, whose lanes start at `at`: into the networks' inputs, the chunk and the word.
LORE_INLINE void sense(LaneWork& work, int at, int step) {
    LaneArena const& arena = work.arena;
    F const x = lanes::load<F>(work.x + at), y = lanes::load<F>(work.y + at);
    I const open = lanes::load<I>(work.door_open + at);
    I const shining = lanes::load<I>(work.balls_mask + at) | static_cast<std::int32_t>(arena.basket_mask) |
                      (lanes::load<I>(work.switch_lit + at) & static_cast<std::int32_t>(arena.switch_mask));
    Known const known = look_up(arena, x, y, open);
    mechanics::Directions<F> const look = mechanics::directions(
        math::SinCos<F>{lanes::load<F>(work.heading_sin + at), lanes::load<F>(work.heading_cos + at)});
    F distances[rays];
    cast_rays(arena, x, y, look, ~open, distances);
    LightsSeen const lights = see_lights(arena, x, y, look, known, shining, open);
    auto const sees = [](I const& seen, std::uint32_t kind) __attribute__((always_inline))->I {
        return (seen & static_cast<std::int32_t>(kind)) != 0;
    };
    // In the order of binary_channels.
    I const binary[] = {sees(lights.right, arena.ball_mask),    sees(lights.left, arena.ball_mask),
                        sees(lights.right, arena.basket_mask),  sees(lights.left, arena.basket_mask),
                        sees(lights.right, arena.switch_mask),  sees(lights.left, arena.switch_mask),
                        lanes::load<I>(work.bumper_right + at), lanes::load<I>(work.bumper_left + at),
                        lanes::load<I>(work.carrying + at)};
    auto const range = [&](F const& distance) __attribute__((always_inline)) {
        return mechanics::range_value(distance, arena.sensor_range, arena.inverse_range);
    };
    // The sensors among continuous_channels, in their order.
    F const continuous[] = {range(distances[0]), range(distances[1]), range(distances[2])};
    static_assert(sizeof binary == binary_count * sizeof(I), "a value for every binary sensor");
    static_assert(sizeof continuous == continuous_sensor_count * sizeof(F), "a value for every continuous sensor");
    I word{};
    for (int b = 0; b < binary_count; ++b) {
        lanes::store(work.buffers.neurons + sensors.binary[b] * row + at, ones_where(binary[b]));
        word |= binary[b] & (1 << b);
    }
    for (int c = 0; c < continuous_sensor_count; ++c) {
        lanes::store(work.buffers.neurons + sensors.continuous[c] * row + at, continuous[c]);
        lanes::store(work.buffers.values + (step * continuous_count + c) * row + at, continuous[c]);
        word |= (continuous[c] > 0.5f) & (1 << (binary_count + c));
    }
    lanes::store(work.word + at, word);
    lanes::store(work.in_reach + at, sees(lights.in_reach, arena.ball_mask | arena.switch_mask));
    lanes::store(work.buffers.x + step * row + at, x);
    lanes::store(work.buffers.y + step * row + at, y);
    work.touchable[at / width] = static_cast<WallSet>(lanes::reduce_or(known.touchable));
}

/// Counts down the pause of the switch, then lets the rules decide where something happens.
LORE_INLINE void act(LaneWork& work, int at, F const& collect) {
    I const collecting = collect >= 0.5f;
    I const carrying = lanes::load<I>(work.carrying + at);
    I eventful = (carrying & ~collecting) | (lanes::load<I>(work.in_reach + at) & collecting & ~carrying);
    if (work.arena.switch_pause > 0) {
        I const lit = lanes::load<I>(work.switch_lit + at), timer = lanes::load<I>(work.switch_timer + at);
        I const pausing = ~lit & (timer > 0);
        // A lamp that is lit again in this very step may be pressed in it; let the rules find out.
        I const relit = ~lit & ~pausing;
        eventful |= relit & collecting & ~carrying;
        lanes::store(work.switch_timer + at, timer + (pausing & ~eventful));
        lanes::store(work.switch_lit + at, lit | (relit & ~eventful));
    }
    for (std::uint32_t left = lanes::mask_bits(eventful); left != 0; left &= left - 1) {
        int const lane = __builtin_ctz(left);
        work.act(work, at + lane, collect[lane]);
    }
}

LORE_INLINE void move(LaneWork& work, int at, F const& left_wheel, F const& right_wheel) {
    LaneArena const& arena = work.arena;
    F const x = lanes::load<F>(work.x + at), y = lanes::load<F>(work.y + at);
    mechanics::Drive<F> const drive =
        mechanics::drive(left_wheel, right_wheel, arena.max_speed, arena.inverse_wheel_distance);
    mechanics::Vector<F> const way = mechanics::arc(
        drive, math::SinCos<F>{lanes::load<F>(work.heading_sin + at), lanes::load<F>(work.heading_cos + at)});
    F const next_x = x + way.x, next_y = y + way.y;
    F const theta = mechanics::wrap(F(lanes::load<F>(work.theta + at) + drive.turn));
    math::SinCos<F> const heading = math::sincos(theta);
    Contact const contact =
        touch_walls(arena, work.touchable[at / width], next_x, next_y, heading, lanes::load<I>(work.door_open + at));
    lanes::store(work.x + at, lanes::select(contact.any, x, next_x));
    lanes::store(work.y + at, lanes::select(contact.any, y, next_y));
    lanes::store(work.theta + at, theta);
    lanes::store(work.heading_sin + at, heading.sin);
    lanes::store(work.heading_cos + at, heading.cos);
    lanes::store(work.bumper_right + at, contact.right);
    lanes::store(work.bumper_left + at, contact.left);
}

/// Counts the still steps of all lanes; true if one comes to more than it may with this step. To one more exactly:
/// lanes whose life has ended are stepped on, and would else stop the others at each of their still steps.
template <int vectors>
LORE_INLINE bool some_stood_still(LaneWork& work, int step) {
    I over{};
    for (int at = 0; at < vectors * width; at += width) {
        I const still = stays(lanes::load<F>(work.buffers.x + step * row + at), lanes::load<F>(work.x + at)) &
                        stays(lanes::load<F>(work.buffers.y + step * row + at), lanes::load<F>(work.y + at)) &
                        stays(lanes::load<F>(work.theta_before + at), lanes::load<F>(work.theta + at));
        I const steps = lanes::load<I>(work.still_steps + at) - still;
        lanes::store(work.still_steps + at, steps);
        over |= still & (steps == work.stop_when_still + 1);
    }
    return lanes::any(over);
}

template <int vectors>
int run(LaneWork& work, int first, int last) {
    constexpr int end = vectors * width;
    bool const counts_still_steps = work.stop_when_still > 0;
    for (int at = 0; at < end; at += width) {
        math::SinCos<F> const heading = math::sincos(lanes::load<F>(work.theta + at));
        lanes::store(work.heading_sin + at, heading.sin);
        lanes::store(work.heading_cos + at, heading.cos);
    }
    for (int step = first; step < last; ++step) {
        work.step = step;
        for (int at = 0; at < end; at += width) sense(work, at, step);
        float* const effectors = work.buffers.values + (step * continuous_count + continuous_sensor_count) * row;
        tick_lanes<width, vectors>(work.buffers.networks, sensor_count, effector_count,
                                   {work.buffers.neurons, work.buffers.next_hidden}, effectors);
        for (int at = 0; at < end; at += width) {
            F const collect = lanes::load<F>(effectors + effector_place(Channel::collect) * row + at);
            I word = lanes::load<I>(work.word + at);
            for (int e = 0; e < effector_count; ++e)
                word |= (lanes::load<F>(effectors + e * row + at) > 0.5f) &
                        (1 << (binary_count + continuous_sensor_count + e));
            lanes::store(work.buffers.words + step * row + at, __builtin_convertvector(word, Words));
            act(work, at, collect);
        }
        if (counts_still_steps)
            for (int at = 0; at < end; at += width)
                lanes::store(work.theta_before + at, lanes::load<F>(work.theta + at));
        for (int at = 0; at < end; at += width)
            move(work, at, lanes::load<F>(effectors + effector_place(Channel::left_wheel) * row + at),
                 lanes::load<F>(effectors + effector_place(Channel::right_wheel) * row + at));
        if (counts_still_steps && some_stood_still<vectors>(work, step)) return step + 1;
    }
    return last;
}

}   // namespace

int run_steps(LaneWork& work, int first, int last) {
    if (work.buffers.vectors == 1) return run<1>(work, first, last);
    return run<lane_vectors>(work, first, last);
}

}   // namespace lore::LORE_ISA_NAMESPACE
