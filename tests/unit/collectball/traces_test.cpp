#include <lore/collectball/geometry.h>
#include <lore/collectball/world.h>

#include <support/traces.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace lore {
namespace {

using tests::TraceRow;

/// The world before a row: what the row above says after its action.
WorldState world_before(Arena const& arena, TraceRow const* above) {
    WorldState world = start_world(arena);
    if (above == nullptr) return world;
    world.balls_mask = static_cast<std::uint16_t>(above->balls_mask());
    world.carried = above->carrying() != 0 ? 0 : -1;
    world.door_open = above->door_open() != 0;
    world.switch_lit = above->switch_on() != 0;
    world.switch_timer = static_cast<std::int16_t>(above->switch_timer());
    world.collected = above->collected();
    return world;
}

/// How deep the disc at the attempted pose is in a wall [u]; negative: how far from the nearest.
double depth(Arena const& arena, double x, double y, bool door_open) {
    Geometry const& g = *arena.geometry;
    double nearest = 1e9;
    for (std::size_t i = 0; i < (door_open ? static_cast<std::size_t>(g.first_door) : g.walls.size()); ++i) {
        Rect const& w = g.walls[i];
        double const dx = std::max({w.x0 - x, x - w.x1, 0.0}), dy = std::max({w.y0 - y, y - w.y1, 0.0});
        nearest = std::min(nearest, std::hypot(dx, dy));
    }
    return arena.robot.radius - nearest;
}

/// True if a wall has a point in the quarter disc on the given side of the heading, whose radius and straight edges are
/// moved outwards by `by` [u]; by sampling.
bool reaches_sector(Arena const& arena, double x, double y, double heading, int side, double by, bool door_open) {
    Geometry const& g = *arena.geometry;
    double const c = std::cos(heading), s = std::sin(heading), radius = arena.robot.radius + by;
    for (double forward = -by; forward < radius; forward += 0.5)
        for (double sideways = -by; sideways < radius; sideways += 0.5) {
            if (forward * forward + sideways * sideways >= radius * radius) continue;
            double const px = x + forward * c - side * sideways * s, py = y + forward * s + side * sideways * c;
            for (std::size_t i = 0; i < (door_open ? static_cast<std::size_t>(g.first_door) : g.walls.size()); ++i) {
                Rect const& w = g.walls[i];
                if (w.x0 <= px && px <= w.x1 && w.y0 <= py && py <= w.y1) return true;
            }
        }
    return false;
}

struct Comparison {
    long ranges = 0, ranges_off = 0, lights = 0, lights_off = 0, bumpers = 0, free_moves = 0;
};

/// Follows one trace; its tolerances are those of the traces' README.
Comparison follow(std::filesystem::path const& path) {
    std::string const name = path.filename().string();
    Arena const arena = load_arena("collectball", name.substr(0, name.find('_')));
    std::vector<TraceRow> const rows = tests::read_trace(path);
    EXPECT_EQ(rows.size(), 4000u) << name;
    Comparison total;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        TraceRow const& row = rows[i];
        WorldState world = world_before(arena, i == 0 ? nullptr : &rows[i - 1]);
        RobotState robot{{static_cast<float>(row.x()), static_cast<float>(row.y()), static_cast<float>(row.theta())},
                         row.sensor(9) > 0.5,
                         row.sensor(10) > 0.5};
        Effectors const actions{static_cast<float>(row.action(0)), static_cast<float>(row.action(1)),
                                static_cast<float>(row.action(2))};
        Sensors const sensors = sense(arena, robot, world);
        for (int k = 0; k < 3; ++k, ++total.ranges)
            total.ranges_off +=
                std::abs(static_cast<double>(sensors[static_cast<std::size_t>(k)]) - row.sensor(k)) > 0.02;
        for (int k = 3; k < 9; ++k, ++total.lights)
            total.lights_off += sensors[static_cast<std::size_t>(k)] != row.sensor(k);
        EXPECT_EQ(sensors[11], row.sensor(11)) << name << " row " << i;

        act(arena, robot.pose, actions, world);
        EXPECT_EQ(world.carrying(), row.carrying() != 0) << name << " row " << i;
        EXPECT_EQ(world.balls_mask, row.balls_mask()) << name << " row " << i;
        EXPECT_EQ(world.collected, row.collected()) << name << " row " << i;
        EXPECT_EQ(world.door_open, row.door_open() != 0) << name << " row " << i;
        EXPECT_EQ(world.switch_lit, row.switch_on() != 0) << name << " row " << i;
        EXPECT_EQ(world.switch_timer, row.switch_timer()) << name << " row " << i;

        // The attempted pose, in double precision and by the textbook's formula.
        double const dl = 4 * (2 * row.action(0) - 1), dr = 4 * (2 * row.action(1) - 1), a = (dr - dl) / 40;
        double u = 0, v = dl;
        if (std::abs(a) > 1e-10) {
            double const r = dl / a + 20;
            u = (std::cos(a) - 1) * r;
            v = std::sin(a) * r;
        }
        double const s = std::sin(row.theta()), c = std::cos(row.theta());
        double const deep = depth(arena, row.x() + u * s + v * c, row.y() - u * c + v * s, world.door_open);
        Pose const before = robot.pose;
        move(arena, actions, world, robot);
        bool const ours_stopped =
            robot.pose.x == before.x && robot.pose.y == before.y && std::abs(u) + std::abs(v) > 1e-3;
        bool const theirs_stopped =
            row.x_next() == row.x() && row.y_next() == row.y() && std::abs(u) + std::abs(v) > 1e-3;
        EXPECT_NEAR(std::remainder(static_cast<double>(robot.pose.theta) - row.theta_next(), 2 * 3.14159265358979), 0.0,
                    1e-3)
            << name << " row " << i;
        if (!ours_stopped && !theirs_stopped) {
            EXPECT_NEAR(robot.pose.x, row.x_next(), 1e-3) << name << " row " << i;
            EXPECT_NEAR(robot.pose.y, row.y_next(), 1e-3) << name << " row " << i;
            ++total.free_moves;
        }
        if (std::abs(deep) <= 3) continue;
        EXPECT_EQ(ours_stopped, theirs_stopped) << name << " row " << i << " depth " << deep;
        if (i + 1 == rows.size()) continue;
        double const ax = row.x() + u * s + v * c, ay = row.y() - u * c + v * s;
        for (int side : {+1, -1}) {
            bool const ours = side > 0 ? robot.bumper_right : robot.bumper_left;
            bool const theirs = rows[i + 1].sensor(side > 0 ? 9 : 10) > 0.5;
            // Clear for this bumper: its sector is reached, or missed, by more than the pixels' error.
            bool const surely = reaches_sector(arena, ax, ay, row.theta_next(), side, -3, world.door_open);
            bool const possibly = deep > 0 && reaches_sector(arena, ax, ay, row.theta_next(), side, 3, world.door_open);
            if (surely != possibly) continue;
            ++total.bumpers;
            EXPECT_EQ(ours, surely) << name << " row " << i;
            EXPECT_EQ(theirs, surely) << name << " row " << i;
        }
    }
    EXPECT_LE(static_cast<double>(total.ranges_off), 0.015 * static_cast<double>(total.ranges)) << name;
    EXPECT_LE(static_cast<double>(total.lights_off), 0.005 * static_cast<double>(total.lights)) << name;
    EXPECT_GT(total.free_moves, 1000) << name;
    return total;
}

TEST(RecordedTraces, are_followed_within_the_tolerances_of_their_readme) {
    auto const files = tests::recorded_traces();
    if (files.empty()) GTEST_SKIP() << "no recorded traces beside the project (set LORE_SHARED)";
    Comparison all;
    for (auto const& file : files) {
        Comparison const one = follow(file);
        all.ranges += one.ranges;
        all.ranges_off += one.ranges_off;
        all.lights += one.lights;
        all.lights_off += one.lights_off;
        all.bumpers += one.bumpers;
    }
    std::printf("%zu traces: range sensors off in %ld of %ld, lights in %ld of %ld, bumpers compared %ld\n",
                files.size(), all.ranges_off, all.ranges, all.lights_off, all.lights, all.bumpers);
    EXPECT_LE(static_cast<double>(all.ranges_off), 0.005 * static_cast<double>(all.ranges));
    EXPECT_LE(static_cast<double>(all.lights_off), 0.005 * static_cast<double>(all.lights));
}

}   // namespace
}   // namespace lore
