#pragma once

namespace lore {

struct Point {
    float x = 0;
    float y = 0;
    friend bool operator==(Point const&, Point const&) = default;
};

/// Axis-aligned wall, x0 < x1, y0 < y1 [u]. y grows downwards.
struct Rect {
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    friend bool operator==(Rect const&, Rect const&) = default;
};

/// Position [u] and heading [rad, in -pi..pi, from +x towards +y].
struct Pose {
    float x = 0;
    float y = 0;
    float theta = 0;
    friend bool operator==(Pose const&, Pose const&) = default;
};

/// Two parallel wall faces over the same interval, of which a ray can hit at most one: it runs up the axis and hits the
/// face at `upward`, or down the axis (or along the faces) and hits the one at `downward`. Infinity: no such face.
///
/// Vertical faces lie at x = upward or downward with y in [lo, hi]; horizontal ones likewise with the axes exchanged.
struct FacePair {
    float upward = 0, downward = 0;   ///< [u]
    float lo = 0, hi = 0;             ///< [u], closed
    bool door = false;                ///< there only while the door is shut
};

}   // namespace lore
