// The episode's inner loop for LORE_LANES robots at once; compiled once per instruction set (lore_kernel). Formulas are
// those of arena/mechanics.h and core/math.h, which the plain episode uses too; here is only their arrangement.
#include "lane_work.h"

#include <lore/arena/mechanics.h>
#include <lore/arena/wall_set.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES;
using F = Lanes<float, width>;
using I = Lanes<std::int32_t, width>;
using Words = Lanes<std::uint16_t, width>;

constexpr int inputs = 12, outputs = 3;

struct Hits { F right, left, ahead; };
using Rays = mechanics::Ray<F>[3];

LORE_INLINE F ones_where(I const& mask) { return lanes::select(mask, lanes::all_of<F>(1.0f), F{}); }

/// One ray against the faces of one line. `first - y` and `last - y` of its intervals serve all rays.
template <bool along_x>
LORE_INLINE void hit_line(LaneArena const& arena, FaceLine const& line, F const& across, F const& along, I const& shut,
                          mechanics::Ray<F> const (&rays)[3], F (&nearest)[3]) {
    F const up = line.upward - across, down = line.downward - across;
    F t[3], reach[3];
    I hit[3];
    for (int r = 0; r < 3; ++r) {
        F const& direction = along_x ? rays[r].direction.y : rays[r].direction.x;
        F const& reciprocal = along_x ? rays[r].reciprocal.y : rays[r].reciprocal.x;
        t[r] = lanes::select(direction > 0.0f, up, down) * reciprocal;
        reach[r] = t[r] * (along_x ? rays[r].direction.x : rays[r].direction.y);
        hit[r] = I{};
    }
    for (int i = line.first; i < line.last; ++i) {
        FaceInterval const& interval = arena.intervals[i];
        F const lo = interval.lo - along, hi = interval.hi - along;
        if (interval.door) {
            for (int r = 0; r < 3; ++r) hit[r] |= (lo <= reach[r]) & (reach[r] <= hi) & shut;
        } else {
            for (int r = 0; r < 3; ++r) hit[r] |= (lo <= reach[r]) & (reach[r] <= hi);
        }
    }
    for (int r = 0; r < 3; ++r) nearest[r] = lanes::select(hit[r] & (t[r] >= 0.0f) & (t[r] < nearest[r]), t[r], nearest[r]);
}

/// Distances along the three rays (right, left, ahead).
LORE_INLINE void cast_rays(LaneArena const& arena, F const& x, F const& y, mechanics::Directions<F> const& look, I const& shut,
                           F (&nearest)[3]) {
    mechanics::Ray<F> const right = mechanics::ray(look.right);
    mechanics::Ray<F> const rays[3] = {right, {look.left, {right.reciprocal.y, -right.reciprocal.x}}, mechanics::ray(look.ahead)};
    for (F& distance : nearest) distance = lanes::all_of<F>(__builtin_inff());
    for (int i = 0; i < arena.vertical_count; ++i) hit_line<false>(arena, arena.vertical[i], x, y, shut, rays, nearest);
    for (int i = 0; i < arena.horizontal_count; ++i) hit_line<true>(arena, arena.horizontal[i], y, x, shut, rays, nearest);
}

/// What the cells where the robots are know (Surroundings::Cell), per lane.
struct Known { I clear, mixed, suspects, touchable; };

LORE_INLINE Known look_up(LaneArena const& arena, F const& x, F const& y, I const& open) {
    // Robots cannot leave the closed arena; the bounds only keep every read inside the table.
    F const column = lanes::min(lanes::max(F(x * arena.cells_per_u), F{}), lanes::all_of<F>(static_cast<float>(arena.columns - 1)));
    F const row = lanes::min(lanes::max(F(y * arena.cells_per_u), F{}), lanes::all_of<F>(static_cast<float>(arena.rows - 1)));
    I const cell = lanes::truncate(row) * arena.columns + lanes::truncate(column) + (open & arena.open_offset);
    I const word = cell * 4;
    return {lanes::gather(arena.cells, word), lanes::gather(arena.cells + 1, word), lanes::gather(arena.cells + 2, word),
            lanes::gather(arena.cells + 3, word)};
}

/// Lights in view of the sensors at each side, and those near enough to be taken or pressed; a bit a light.
struct LightsSeen { I right, left, in_reach; };

LORE_INLINE LightsSeen see_lights(LaneArena const& arena, F const& x, F const& y, mechanics::Directions<F> const& look,
                                  Known const& known, I const& shining, I const& open) {
    I right{}, left{}, near{};
    I const possible = (known.clear | known.mixed | static_cast<std::int32_t>(arena.always_asked)) & shining;
    for (std::uint32_t asked = lanes::reduce_or(possible); asked != 0; asked &= asked - 1) {
        int const light = __builtin_ctz(asked);
        std::int32_t const bit = 1 << light;
        F const vx = arena.lights[light].x - x, vy = arena.lights[light].y - y;
        right |= mechanics::in_view(vx, vy, look.right, arena.cos_squared_half_view) & bit;
        left |= mechanics::in_view(vx, vy, look.left, arena.cos_squared_half_view) & bit;
        near |= (vx * vx + vy * vy < arena.reach_squared) & bit;
    }
    I visible = (known.clear | known.mixed) & shining;
    I const doubtful = (right | left) & known.mixed & shining;
    if (std::uint32_t asked = lanes::reduce_or(doubtful); asked != 0) {
        WallSet const suspects = lanes::reduce_or(known.suspects & (doubtful != 0));
        for (; asked != 0; asked &= asked - 1) {
            int const light = __builtin_ctz(asked);
            F const light_x = lanes::all_of<F>(arena.lights[light].x), light_y = lanes::all_of<F>(arena.lights[light].y);
            visit_walls(suspects, arena.wall_count, [&](int wall) __attribute__((always_inline)) {
                I crossed = mechanics::segment_meets(arena.walls[wall], x, y, light_x, light_y);
                if (wall >= arena.first_door) crossed &= ~open;
                // Where the light is clear no wall crosses, so lanes need not be told apart.
                visible &= ~(crossed & (1 << light));
            });
        }
    }
    return {right & visible, left & visible, near & shining};
}

/// What the attempted move meets.
struct Contact { I any, right, left; };

LORE_INLINE Contact touch_walls(LaneArena const& arena, WallSet touchable, F const& x, F const& y, math::SinCos<F> const& heading, I const& open) {
    Contact contact{};
    visit_walls(touchable, arena.wall_count, [&](int i) __attribute__((always_inline)) {
        Rect const& wall = arena.walls[i];
        I touched = mechanics::touches(wall, x, y, arena.radius_squared);
        if (i >= arena.first_door) touched &= ~open;
        if (!lanes::any(touched)) return;
        auto const pressed = mechanics::bumpers(wall, x, y, heading, arena.radius);
        contact.any |= touched;
        contact.right |= pressed.right & touched;
        contact.left |= pressed.left & touched;
    });
    return contact;
}

LORE_INLINE F activation(F const& bias, F const& sum) { return 1.0f / (1.0f + math::exp(F(bias - sum))); }

template <int count>
LORE_INLINE void tick_group(LaneWork& work, NeuronGroup const& group, F (&output)[outputs]) {
    LaneNetworks const& networks = work.networks;
    F sums[count] = {};
    for (int entry = group.first_entry; entry < group.last_entry; ++entry) {
        F const source = lanes::load<F>(work.neurons + networks.sources[entry] * width);
        float const* weights = networks.weights + networks.offsets[entry];
        for (int k = 0; k < count; ++k) sums[k] += lanes::load<F>(weights + k * width) * source;
    }
    for (int k = 0; k < count; ++k) {
        int const target = group.first_target + k;
        F const y = activation(lanes::load<F>(networks.biases + target * width), sums[k]);
        if (count == outputs) output[k] = y;   // only the first group has three targets
        else lanes::store(work.next_hidden + (target - outputs) * width, y);
    }
}

LORE_INLINE void tick(LaneWork& work, F (&output)[outputs]) {
    for (int g = 0; g < work.networks.group_count; ++g) {
        NeuronGroup const& group = work.networks.groups[g];
        switch (group.count) {
        case 3: tick_group<3>(work, group, output); break;
        case 4: tick_group<4>(work, group, output); break;
        case 2: tick_group<2>(work, group, output); break;
        default: tick_group<1>(work, group, output); break;
        }
    }
    for (int i = 0; i < work.networks.hidden_count * width; i += width)
        lanes::store(work.neurons + inputs * width + i, lanes::load<F>(work.next_hidden + i));
}

/// Counts down the pause of the switch, then lets the rules decide where something happens.
LORE_INLINE void act(LaneWork& work, F const& collect, I const& in_reach) {
    I const collecting = collect >= 0.5f;
    I const carrying = lanes::load<I>(work.carrying);
    I eventful = (carrying & ~collecting) | (in_reach & collecting & ~carrying);
    if (work.arena.switch_pause > 0) {
        I const lit = lanes::load<I>(work.switch_lit), timer = lanes::load<I>(work.switch_timer);
        I const pausing = ~lit & (timer > 0);
        // A lamp that is lit again in this very step may be pressed in it; let the rules find out.
        I const relit = ~lit & ~pausing;
        eventful |= relit & collecting & ~carrying;
        lanes::store(work.switch_timer, timer + (pausing & ~eventful));
        lanes::store(work.switch_lit, lit | (relit & ~eventful));
    }
    for (std::uint32_t left = lanes::mask_bits(eventful); left != 0; left &= left - 1) {
        int const lane = __builtin_ctz(left);
        work.act(work, lane, collect[lane]);
    }
}

} // namespace

void run_steps(LaneWork& work, int first, int last) {
    LaneArena const& arena = work.arena;
    F x = lanes::load<F>(work.x), y = lanes::load<F>(work.y), theta = lanes::load<F>(work.theta);
    I bumper_right = lanes::load<I>(work.bumper_right), bumper_left = lanes::load<I>(work.bumper_left);
    math::SinCos<F> heading = math::sincos(theta);

    for (int step = first; step < last; ++step) {
        I open = lanes::load<I>(work.door_open);
        I const carrying = lanes::load<I>(work.carrying);
        I const shining = lanes::load<I>(work.balls) | static_cast<std::int32_t>(arena.basket_mask)
                        | (lanes::load<I>(work.switch_lit) & static_cast<std::int32_t>(arena.switch_mask));

        Known const known = look_up(arena, x, y, open);
        mechanics::Directions<F> const look = mechanics::directions(heading);
        F distances[3];
        cast_rays(arena, x, y, look, ~open, distances);
        LightsSeen const lights = see_lights(arena, x, y, look, known, shining, open);
        auto const sees = [](I const& seen, std::uint32_t kind) __attribute__((always_inline)) -> I { return (seen & static_cast<std::int32_t>(kind)) != 0; };

        F sensed[3];
        for (int r = 0; r < 3; ++r) sensed[r] = mechanics::range_value(distances[r], arena.sensor_range, arena.inverse_range);
        I const binary[9] = {sees(lights.right, arena.ball_mask), sees(lights.left, arena.ball_mask),
                             sees(lights.right, arena.basket_mask), sees(lights.left, arena.basket_mask),
                             sees(lights.right, arena.switch_mask), sees(lights.left, arena.switch_mask),
                             bumper_right, bumper_left, carrying};
        for (int r = 0; r < 3; ++r) lanes::store(work.neurons + r * width, sensed[r]);
        for (int b = 0; b < 9; ++b) lanes::store(work.neurons + (3 + b) * width, ones_where(binary[b]));
        F effectors[outputs];
        tick(work, effectors);

        float* const values = work.values + step * 6 * width;
        I word{};
        for (int b = 0; b < 9; ++b) word |= binary[b] & (1 << b);
        for (int c = 0; c < 3; ++c) {
            lanes::store(values + c * width, sensed[c]);
            lanes::store(values + (3 + c) * width, effectors[c]);
            word |= (sensed[c] > 0.5f) & (1 << (9 + c));
            word |= (effectors[c] > 0.5f) & (1 << (12 + c));
        }
        lanes::store(work.words + step * width, __builtin_convertvector(word, Words));
        lanes::store(work.trail_x + step * width, x);
        lanes::store(work.trail_y + step * width, y);

        lanes::store(work.x, x);
        lanes::store(work.y, y);
        act(work, effectors[2], sees(lights.in_reach, arena.ball_mask | arena.switch_mask));
        open = lanes::load<I>(work.door_open);

        mechanics::Drive<F> const drive = mechanics::drive(effectors[0], effectors[1], arena.max_speed, arena.inverse_wheel_distance);
        mechanics::Vector<F> const way = mechanics::arc(drive, heading);
        F const next_x = x + way.x, next_y = y + way.y;
        theta = mechanics::wrap(F(theta + drive.turn));
        heading = math::sincos(theta);

        Contact const contact = touch_walls(arena, lanes::reduce_or(known.touchable), next_x, next_y, heading, open);
        bumper_right = contact.right;
        bumper_left = contact.left;
        x = lanes::select(contact.any, x, next_x);
        y = lanes::select(contact.any, y, next_y);
    }

    lanes::store(work.x, x);
    lanes::store(work.y, y);
    lanes::store(work.theta, theta);
    lanes::store(work.bumper_right, bumper_right);
    lanes::store(work.bumper_left, bumper_left);
}

} // namespace lore::LORE_ISA_NAMESPACE
