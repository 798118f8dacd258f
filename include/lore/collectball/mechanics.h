#pragma once

#include <lore/collectball/shapes.h>
#include <lore/core/math.h>

/// The formulas of body and senses, one template for a float and for a vector of floats (core/lanes.h), so that the
/// plain simulation and the one that runs many robots at once give the same bits. The order of the operations as
/// written, in float32 and without fused multiply-add, is part of the definition of every result.
///
/// None of them branches on data, divides by a difference that may be 0, or hides a NaN.
namespace lore::mechanics {

/// A direction or displacement [u].
template <class F>
struct Vector {
    F x, y;
};

inline constexpr float sqrt_half = 0.707106781f;
inline constexpr float two_pi = 6.28318530717958f;

// ---- motion -------------------------------------------------------------------------------------------------------

/// What the wheels do in one step: the angle turned [rad] and the length of the way [u].
template <class F>
struct Drive {
    F turn, way;
};

/// Wheel outputs in [0, 1]; the displacement of a wheel is max_speed (2 o - 1).
template <class F>
LORE_INLINE Drive<F> drive(F const& left, F const& right, float max_speed, float inverse_wheel_distance) {
    F const dl = (left * 2.0f - 1.0f) * max_speed;
    F const dr = (right * 2.0f - 1.0f) * max_speed;
    return {(dr - dl) * inverse_wheel_distance, (dl + dr) * 0.5f};
}

/// Largest turn in one step for which the series of `arc` are exact to float32 [rad].
inline constexpr float most_turn = 0.5f;

/// Displacement along the arc that turns by `turn` and is `way` long, starting with the given heading.
///
/// With a = turn: way ((cos a - 1)/a, sin(a)/a) in the frame rotated by theta - pi/2. Both factors are Taylor series:
/// nothing special happens at a = 0, nothing cancels; the first terms left out are a^9/3628800 and a^8/362880.
template <class F>
LORE_INLINE Vector<F> arc(Drive<F> const& d, math::SinCos<F> const& heading) {
    F const square = d.turn * d.turn;
    F const sideways =
        d.turn * (((square * (1.0f / 40320.0f) - 1.0f / 720.0f) * square + 1.0f / 24.0f) * square - 0.5f);
    F const forward = ((square * (-1.0f / 5040.0f) + 1.0f / 120.0f) * square - 1.0f / 6.0f) * square + 1.0f;
    F const u = d.way * sideways;
    F const v = d.way * forward;
    return {u * heading.sin + v * heading.cos, v * heading.sin - u * heading.cos};
}

/// theta in [-pi, pi] again, after a step's turn.
template <class F>
LORE_INLINE F wrap(F const& theta) {
    F const below = lanes::select(theta > math::pi, theta - two_pi, theta);
    return lanes::select(below < -math::pi, below + two_pi, below);
}

// ---- contact ------------------------------------------------------------------------------------------------------

/// True if a disc around (x, y) touches the wall: squared distance to its nearest point < radius^2 (strict).
template <class F>
LORE_INLINE auto touches(Rect const& wall, F const& x, F const& y, float radius_squared) {
    F const gap_x = lanes::max(lanes::max(wall.x0 - x, x - wall.x1), F{});
    F const gap_y = lanes::max(lanes::max(wall.y0 - y, y - wall.y1), F{});
    return gap_x * gap_x + gap_y * gap_y < radius_squared;
}

/// Here and below a wall is a Rect, or a struct of the same members that holds another wall in every lane.
///
/// True if the closed segment from p to q meets the closed wall: no axis x, y or normal to the segment separates them.
template <class Wall, class F>
LORE_INLINE auto segment_meets(Wall const& wall, F const& px, F const& py, F const& qx, F const& qy) {
    auto const half_width = (wall.x1 - wall.x0) * 0.5f;
    auto const half_height = (wall.y1 - wall.y0) * 0.5f;
    F const hx = (qx - px) * 0.5f, hy = (qy - py) * 0.5f;
    F const rx = (px + qx) * 0.5f - (wall.x0 + wall.x1) * 0.5f;
    F const ry = (py + qy) * 0.5f - (wall.y0 + wall.y1) * 0.5f;
    F const ax = lanes::abs(hx), ay = lanes::abs(hy);
    return (lanes::abs(rx) <= ax + half_width) & (lanes::abs(ry) <= ay + half_height) &
           (lanes::abs(hx * ry - hy * rx) <= ay * half_width + ax * half_height);
}

template <class M>
struct Bumpers {
    M right, left;
};

/// Which bumpers a touched wall presses: some point of it within the radius has a bearing strictly between 0 and pi/2
/// (right, the +45 degree side) or -pi/2 and 0 (left), relative to `heading`.
///
/// The wall and the sector are convex, so if the wall's nearest point lies outside the sector, the wall enters it
/// across the ray ahead or the ray at +-90 degrees; and if it meets such a ray, it enters the sector just if it
/// reaches beyond the ray. Precondition: touches().
template <class Wall, class F>
LORE_INLINE auto bumpers(Wall const& wall, F const& x, F const& y, math::SinCos<F> const& heading, float radius) {
    F const& c = heading.cos;
    F const& s = heading.sin;
    F const x0 = wall.x0 - x, x1 = wall.x1 - x, y0 = wall.y0 - y, y1 = wall.y1 - y;
    // The wall's nearest point and its extent, forward and to the right.
    F const nx = lanes::max(x0, lanes::min(x1, F{}));
    F const ny = lanes::max(y0, lanes::min(y1, F{}));
    F const forward = nx * c + ny * s;
    F const rightward = ny * c - nx * s;
    F const most_forward = lanes::max(x0 * c, x1 * c) + lanes::max(y0 * s, y1 * s);
    F const most_right = lanes::max(y0 * c, y1 * c) - lanes::min(x0 * s, x1 * s);
    F const most_left = lanes::max(x0 * s, x1 * s) - lanes::min(y0 * c, y1 * c);
    F const rc = c * radius, rs = s * radius;
    auto const ahead = segment_meets(wall, x, y, x + rc, y + rs);
    auto const at_right = segment_meets(wall, x, y, x - rs, y + rc);
    auto const at_left = segment_meets(wall, x, y, x + rs, y - rc);
    auto const right =
        ((forward > 0.0f) & (rightward > 0.0f)) | (ahead & (most_right > 0.0f)) | (at_right & (most_forward > 0.0f));
    auto const left =
        ((forward > 0.0f) & (rightward < 0.0f)) | (ahead & (most_left > 0.0f)) | (at_left & (most_forward > 0.0f));
    return Bumpers<std::remove_const_t<decltype(right)>>{right, left};
}

// ---- range sensors ------------------------------------------------------------------------------------------------

/// The directions of the sensors at 0, +45 (right) and -45 degrees (left), from one sine and cosine.
template <class F>
struct Directions {
    Vector<F> ahead, right, left;
};

template <class F>
LORE_INLINE Directions<F> directions(math::SinCos<F> const& heading) {
    F const x = (heading.cos - heading.sin) * sqrt_half;
    F const y = (heading.cos + heading.sin) * sqrt_half;
    return {{heading.cos, heading.sin}, {x, y}, {y, -x}};
}

/// A ray in the frame of its origin, with 1 / direction (infinite where the direction is 0). The reciprocals of `left`
/// are those of `right` exchanged and negated, to the bit.
template <class F>
struct Ray {
    Vector<F> direction, reciprocal;
};

template <class F>
LORE_INLINE Ray<F> ray(Vector<F> const& d) {
    return {d, {1.0f / d.x, 1.0f / d.y}};
}

/// The smaller of `nearest` and the distance at which the ray hits one of the two faces.
///
/// Only the face that looks towards the ray's origin can be hit; faces are closed intervals and are not trimmed where
/// walls meet, so no ray slips through a corner. A ray parallel to the faces has an infinite reciprocal: t is infinite
/// or NaN, all of it compares false, and the face is not hit.
template <class F>
LORE_INLINE F hit_vertical(FacePair const& face, F const& x, F const& y, Ray<F> const& r, F const& nearest) {
    F const t = lanes::select(r.direction.x > 0.0f, face.upward - x, face.downward - x) * r.reciprocal.x;
    F const along = t * r.direction.y;
    return lanes::select((t >= 0.0f) & (face.lo - y <= along) & (along <= face.hi - y) & (t < nearest), t, nearest);
}

template <class F>
LORE_INLINE F hit_horizontal(FacePair const& face, F const& x, F const& y, Ray<F> const& r, F const& nearest) {
    F const t = lanes::select(r.direction.y > 0.0f, face.upward - y, face.downward - y) * r.reciprocal.y;
    F const along = t * r.direction.x;
    return lanes::select((t >= 0.0f) & (face.lo - x <= along) & (along <= face.hi - x) & (t < nearest), t, nearest);
}

/// 1 at the wall, falling linearly to 0 at the sensor's range and beyond; in [0, 1].
template <class F>
LORE_INLINE F range_value(F const& distance, float range, float inverse_range) {
    return lanes::select(distance < range, 1.0f - distance * inverse_range, F{});
}

// ---- light sensors ------------------------------------------------------------------------------------------------

/// True if a light at (vx, vy) from the robot lies strictly within half the field of view of the sensor's direction.
/// Precondition: half the field of view is below 90 degrees.
template <class F>
LORE_INLINE auto in_view(F const& vx, F const& vy, Vector<F> const& direction, float cos_squared_half_view) {
    F const dot = vx * direction.x + vy * direction.y;
    return (dot > 0.0f) & (dot * dot > (vx * vx + vy * vy) * cos_squared_half_view);
}

}   // namespace lore::mechanics
