#pragma once

#include <lore/core/lanes.h>
#include <lore/core/math.h>
#include <lore/episode/lane_rules.h>

namespace lore {

/// A wall without thickness, from (x0, y0) to (x1, y1) [u], and what the rules need of it.
struct MazeWall {
    float x0, y0, x1, y1;
    float way_x, way_y;       ///< from end to end [u]
    float share_x, share_y;   ///< the same by the squared length: a way's product with it is a share of the wall
};

/// Most walls of a maze.
inline constexpr int most_maze_walls = 16;

/// A robot in a maze, as rules (episode/lane_rules.h): six range sensors, four pie slices that point to the goal, two
/// effectors that change how fast it turns and how fast it goes. Headings are clockwise as y grows downwards.
///
/// Source: J. Lehman and K. O. Stanley, Abandoning objectives: evolution through the search for novelty alone,
/// Evolutionary Computation 19 (2011), "maze navigation experiment". Its paper and the reimplementations that the mazes
/// are taken from (maze.cpp) have these numbers.
struct MazeRules {
    static constexpr float radius = 8;                ///< of the robot [u]
    static constexpr float range = 100;               ///< of the range sensors [u]
    static constexpr float most_speed = 3;            ///< [u/step]
    static constexpr float degree = math::pi / 180;   ///< [rad]
    static constexpr float most_turn = 3 * degree;    ///< [rad/step]
    static constexpr float goal_radius = 5;           ///< nearer than this the goal is reached [u]

    int wall_count;
    MazeWall walls[most_maze_walls];
    float start_x, start_y, goal_x, goal_y;   ///< [u]
    float start_distance;                     ///< from the goal [u]
    float reward_of_way;                      ///< [1/u] gained

    // ---- a step ----------------------------------------------------------------------------------------------------

    static constexpr int sensors = 10, effectors = 2;
    static constexpr bool binary[sensors + effectors] = {false, false, false, false, false, false,   // ranges
                                                         true,  true,  true,  true,                  // pie slices
                                                         false, false};

    template <class F>
    struct State {
        F x, y;               ///< [u]
        F heading;            ///< in [-pi, pi], 0 along x [rad]
        F cosine, sine;       ///< of the heading
        F speed, turn;        ///< [u/step], [rad/step]
        F distance_to_goal;   ///< [u]
    };

    LORE_INLINE State<float> start() const { return {start_x, start_y, 0, 1, 0, 0, 0, start_distance}; }

    /// Ranges: left, front left, front, front right, right, back, each the share of the range that is free. Slices of
    /// 90 degrees, the goal is in one of them: front, right, back, left.
    template <class F>
    LORE_INLINE void sense(State<F> const& robot, F* values) const {
        see_walls(robot, values);
        auto const [ahead, right] = from_robot(robot, goal_x, goal_y);
        F const far_ahead = lanes::abs(ahead), far_right = lanes::abs(right), one = lanes::all_of<F>(1.0f), none{};
        auto const lengthwise = far_ahead >= far_right, crosswise = far_ahead < far_right;
        values[6] = lanes::select(lengthwise & (ahead >= 0.0f), one, none);
        values[7] = lanes::select(crosswise & (right >= 0.0f), one, none);
        values[8] = lanes::select(lengthwise & (ahead < 0.0f), one, none);
        values[9] = lanes::select(crosswise & (right < 0.0f), one, none);
    }

    /// Turns and moves; a robot that would touch a wall keeps its place. The reward is reward_of_way for each u that it
    /// came nearer to the goal, and 1 for reaching it, which ends the life.
    template <class F>
    LORE_INLINE LaneStep<F> act(State<F>& robot, F const* changes) const {
        robot.turn = within(F(robot.turn + (changes[0] - 0.5f) * degree), most_turn);
        robot.speed = within(F(robot.speed + (changes[1] - 0.5f)), most_speed);
        F const x = robot.x + robot.cosine * robot.speed, y = robot.y + robot.sine * robot.speed;
        auto const touches = touches_wall(x, y);
        robot.x = lanes::select(touches, robot.x, x);
        robot.y = lanes::select(touches, robot.y, y);
        F const heading = robot.heading + robot.turn;
        robot.heading = lanes::select(
            lanes::abs(heading) > math::pi,
            F(heading - lanes::select(heading > 0.0f, lanes::all_of<F>(2 * math::pi), lanes::all_of<F>(-2 * math::pi))),
            heading);
        auto const [sine, cosine] = math::sincos(robot.heading);
        robot.sine = sine;
        robot.cosine = cosine;
        F const before = robot.distance_to_goal, dx = goal_x - robot.x, dy = goal_y - robot.y;
        robot.distance_to_goal = lanes::sqrt(F(dx * dx + dy * dy));
        auto const arrived = robot.distance_to_goal < goal_radius;
        F const reward =
            (before - robot.distance_to_goal) * reward_of_way + lanes::select(arrived, lanes::all_of<F>(1.0f), F{});
        return {reward, arrived};
    }

    /// Where the robot ends: the behavior of the literature.
    LORE_INLINE void outcome(State<float> const& robot, float* values) const {
        values[0] = robot.x;
        values[1] = robot.y;
    }

    // ---- geometry --------------------------------------------------------------------------------------------------

    /// A place as the robot has it before it [u].
    template <class F>
    struct Place {
        F ahead, right;
    };

    template <class F>
    LORE_INLINE static Place<F> from_robot(State<F> const& robot, float place_x, float place_y) {
        F const dx = place_x - robot.x, dy = place_y - robot.y;
        return {dx * robot.cosine + dy * robot.sine, dy * robot.cosine - dx * robot.sine};
    }

    /// The six ranges.
    ///
    /// A wall from a to b meets a line through the robot where its ends lie on both sides of it, at the distance
    /// area / (side_a - side_b): `side` is how far right of the line an end is, and the area (twice that of the
    /// triangle of robot, a and b) is the same for all lines. The nearest wall has the largest inverse of that
    /// distance, so that one division a wall serves all rays; the negative inverses are of the rays backwards. A wall
    /// that lies along the line gives 0/0, which max leaves out.
    template <class F>
    LORE_INLINE void see_walls(State<F> const& robot, F* values) const {
        F left{}, front_left{}, front{}, front_right{}, right{}, back{};   // 1/distance of the nearest wall, 0: none
        for (int w = 0; w < wall_count; ++w) {
            Place<F> const a = from_robot(robot, walls[w].x0, walls[w].y0),
                           b = from_robot(robot, walls[w].x1, walls[w].y1);
            F const inverse_area = 1.0f / (b.ahead * a.right - a.ahead * b.right);
            auto const nearness = [&](F const& side_a, F const& side_b) __attribute__((always_inline))->F {
                return lanes::select(side_a * side_b <= 0.0f, F((side_a - side_b) * inverse_area), F{});
            };
            F const lengthwise = nearness(a.right, b.right), crosswise = nearness(F(-a.ahead), F(-b.ahead));
            front = lanes::max(lengthwise, front);
            back = lanes::max(F(-lengthwise), back);
            right = lanes::max(crosswise, right);
            left = lanes::max(F(-crosswise), left);
            // The sides of the diagonals are sqrt(2) times too large; see below.
            front_right = lanes::max(nearness(F(a.right - a.ahead), F(b.right - b.ahead)), front_right);
            front_left = lanes::max(nearness(F(a.right + a.ahead), F(b.right + b.ahead)), front_left);
        }
        constexpr float diagonal = range * 0.707106781f;
        values[0] = free_share(left, range);
        values[1] = free_share(front_left, diagonal);
        values[2] = free_share(front, range);
        values[3] = free_share(front_right, diagonal);
        values[4] = free_share(right, range);
        values[5] = free_share(back, range);
    }

    template <class F>
    LORE_INLINE static F free_share(F const& nearness, float unit) {
        return 1.0f / lanes::max(F(nearness * unit), lanes::all_of<F>(1.0f));
    }

    /// True if the nearest point of a wall is nearer than the radius.
    template <class F>
    LORE_INLINE auto touches_wall(F const& x, F const& y) const {
        F least = lanes::all_of<F>(__builtin_inff());   // squared distance
        for (int w = 0; w < wall_count; ++w) {
            MazeWall const& wall = walls[w];
            F const dx = x - wall.x0, dy = y - wall.y0;
            F const share =
                lanes::min(lanes::max(F(dx * wall.share_x + dy * wall.share_y), F{}), lanes::all_of<F>(1.0f));
            F const gap_x = dx - share * wall.way_x, gap_y = dy - share * wall.way_y;
            least = lanes::min(F(gap_x * gap_x + gap_y * gap_y), least);
        }
        return least < radius * radius;
    }

    template <class F>
    LORE_INLINE static F within(F const& value, float most) {
        return lanes::max(lanes::min(value, lanes::all_of<F>(most)), lanes::all_of<F>(-most));
    }
};

}   // namespace lore
