#include <lore/collectball/geometry.h>
#include <lore/collectball/mechanics.h>

#include <lore/core/random.h>

#include "arena_support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lore {
namespace {

/// Distance at which a ray enters the first rectangle, by the slab method in double precision.
double distance_by_slabs(Geometry const& g, double x, double y, double dx, double dy, bool door_open) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < (door_open ? static_cast<std::size_t>(g.first_door) : g.walls.size()); ++i) {
        Rect const& w = g.walls[i];
        double const ax = (w.x0 - x) / dx, bx = (w.x1 - x) / dx, ay = (w.y0 - y) / dy, by = (w.y1 - y) / dy;
        double const enter = std::max(std::min(ax, bx), std::min(ay, by)),
                     leave = std::min(std::max(ax, bx), std::max(ay, by));
        if (enter <= leave && leave >= 0) nearest = std::min(nearest, std::max(enter, 0.0));
    }
    return nearest;
}

/// A place where the robot's disc touches nothing.
Point free_place(Arena const& arena, Stream& rng, bool door_open) {
    while (true) {
        Point const p{static_cast<float>(rng.uniform(0, arena.width)),
                      static_cast<float>(rng.uniform(0, arena.height))};
        if (!disc_touches(*arena.geometry, p.x, p.y, door_open)) return p;
    }
}

TEST(CastRay, measures_to_the_walls_of_a_room) {
    Arena const arena = tests::room();
    Geometry const& g = *arena.geometry;
    EXPECT_EQ(cast_ray(g, 100, 100, 1, 0, false), 90.0f);
    EXPECT_EQ(cast_ray(g, 100, 100, -1, 0, false), 90.0f);
    EXPECT_EQ(cast_ray(g, 50, 100, 0, -1, false), 90.0f);
    EXPECT_EQ(cast_ray(g, 50, 150, 0, 1, false), 40.0f);
    EXPECT_NEAR(cast_ray(g, 100, 100, mechanics::sqrt_half, mechanics::sqrt_half, false), 90 * std::sqrt(2.0), 1e-3)
        << "into the corner";
}

TEST(CastRay, passes_a_door_when_it_is_open) {
    Arena const arena = tests::room({{120, 130, 10, 80}, {120, 130, 120, 190}}, {{120, 130, 80, 120}});
    EXPECT_EQ(cast_ray(*arena.geometry, 100, 100, 1, 0, false), 20.0f);
    EXPECT_EQ(cast_ray(*arena.geometry, 100, 100, 1, 0, true), 90.0f);
    EXPECT_EQ(cast_ray(*arena.geometry, 100, 80, 1, 0, false), 20.0f) << "at the joint of wall and door";
}

TEST(CastRay, agrees_with_the_slab_method_on_whole_rectangles) {
    Arena const arena = load_arena("collectball", "source");
    Stream rng{4, Purpose::test};
    for (int i = 0; i < 20000; ++i) {
        bool const open = rng.coin();
        Point const p = free_place(arena, rng, open);
        double const angle = rng.uniform(-3.14159265, 3.14159265);
        float const dx = static_cast<float>(std::cos(angle)), dy = static_cast<float>(std::sin(angle));
        double const expected = distance_by_slabs(*arena.geometry, p.x, p.y, dx, dy, open);
        double const reached = cast_ray(*arena.geometry, p.x, p.y, dx, dy, open);
        ASSERT_TRUE(std::isfinite(reached)) << "the arena leaks from (" << p.x << ", " << p.y << ") at " << angle;
        if (std::abs(reached - expected) > 1e-2) {   // a corner within rounding of the ray
            double const one_side =
                distance_by_slabs(*arena.geometry, p.x, p.y, std::cos(angle + 1e-5), std::sin(angle + 1e-5), open);
            double const other_side =
                distance_by_slabs(*arena.geometry, p.x, p.y, std::cos(angle - 1e-5), std::sin(angle - 1e-5), open);
            EXPECT_TRUE(std::abs(reached - one_side) < 1e-1 || std::abs(reached - other_side) < 1e-1) << i;
        }
    }
}

TEST(Geometry, leaves_out_faces_that_no_ray_can_hit_first) {
    Arena const arena = load_arena("collectball", "source");
    int faces = 0;
    for (auto const* pairs : {&arena.geometry->vertical, &arena.geometry->horizontal})
        for (FacePair const& pair : *pairs) faces += std::isfinite(pair.upward) + std::isfinite(pair.downward);
    EXPECT_EQ(faces, 24) << "of 44: 4 of the border, 2 of the door, 3 of each of the other 6 walls";
    EXPECT_LE(arena.geometry->vertical.size() + arena.geometry->horizontal.size(), 12u);
}

TEST(LightVisible, is_blocked_by_walls_and_by_the_shut_door) {
    Arena const arena = load_arena("collectball", "source");
    Geometry const& g = *arena.geometry;
    EXPECT_TRUE(light_visible(g, 0, 296.25f, 101.25f, false)) << "ball 0 from the start";
    EXPECT_FALSE(light_visible(g, 4, 296.25f, 101.25f, false)) << "ball 4 is in the left room";
    EXPECT_FALSE(light_visible(g, 6, 260.0f, 300.0f, false)) << "ball 6 behind the shut door";
    EXPECT_TRUE(light_visible(g, 6, 260.0f, 300.0f, true)) << "ball 6 through the open door";
}

TEST(VisibleLights, are_exactly_those_of_the_definition) {
    for (char const* task : {"source", "target"}) {
        Arena const arena = load_arena("collectball", task);
        Geometry const& g = *arena.geometry;
        Stream rng{5, Purpose::test};
        std::uint32_t const all = (1u << g.lights.size()) - 1u;
        for (int i = 0; i < 500000; ++i) {
            bool const open = rng.coin();
            float x = static_cast<float>(rng.uniform(-5, arena.width + 5)),
                  y = static_cast<float>(rng.uniform(-5, arena.height + 5));
            if (i % 4 == 0) x = static_cast<float>(std::round(x / 2) * 2);   // on the cells' edges
            if (i % 8 == 0) y = std::nextafter(static_cast<float>(std::round(y / 2) * 2), i % 16 == 0 ? -1e9f : 1e9f);
            std::uint32_t expected = 0;
            for (std::size_t light = 0; light < g.lights.size(); ++light)
                expected |= std::uint32_t{light_visible(g, static_cast<int>(light), x, y, open)} << light;
            ASSERT_EQ(visible_lights(g, all, x, y, open), expected) << x << ", " << y << " open " << open;
        }
    }
}

TEST(Surroundings, name_every_wall_that_a_step_may_touch) {
    for (char const* task : {"source", "target"}) {
        Arena const arena = load_arena("collectball", task);
        Geometry const& g = *arena.geometry;
        Stream rng{6, Purpose::test};
        int touched = 0;
        for (int i = 0; i < 200000; ++i) {
            bool const open = rng.coin();
            auto const x = static_cast<float>(rng.uniform(0, arena.width)),
                       y = static_cast<float>(rng.uniform(0, arena.height));
            auto const way = static_cast<float>(rng.uniform(0, arena.robot.max_speed));
            auto const direction = math::sincos(static_cast<float>(rng.uniform(-3, 3)));
            WallSet const touchable = g.surroundings().at(x, y, open).touchable;
            int const walls = open ? g.first_door : static_cast<int>(g.walls.size());
            for (int wall = 0; wall < walls; ++wall) {
                if (!mechanics::touches(g.walls[static_cast<std::size_t>(wall)], x + way * direction.cos,
                                        y + way * direction.sin, g.radius_squared))
                    continue;
                ASSERT_TRUE(touchable & wall_bit(wall)) << x << ", " << y << ", wall " << wall;
                ++touched;
            }
        }
        EXPECT_GT(touched, 10000);
    }
}

TEST(Surroundings, are_the_same_whether_cells_are_asked_in_blocks_or_each_for_itself) {
    auto const expect_same = [](float size, std::vector<Rect> const& walls, int first_door,
                                std::vector<Point> const& lights) {
        auto const cells = [&](int block) { return survey(size, size, walls, first_door, lights, 24, block).cells; };
        auto const alone = cells(1);
        EXPECT_EQ(cells(8), alone);
        EXPECT_EQ(cells(3), alone);
    };
    Arena const source = load_arena("collectball", "source");
    Geometry const& g = *source.geometry;
    expect_same(600, g.walls, g.first_door, g.lights);
    Stream rng{7, Purpose::test};
    auto const place = [&] { return static_cast<float>(rng.uniform(0, 120)); };
    for (int arena = 0; arena < 20; ++arena) {
        std::vector<Rect> walls;
        for (int wall = 0; wall < 5; ++wall) {
            float const x = place(), y = place();
            walls.push_back({x, x + 1 + place() / 3, y, y + 1 + place() / 3});
        }
        std::vector<Point> lights;
        for (int light = 0; light < 1 + arena; ++light) lights.push_back({place(), place()});   // up to 20
        expect_same(120, walls, arena % 2 == 0 ? 4 : 5, lights);                                // with a door, without
    }
}

TEST(VisitWalls, reaches_every_wall_of_the_set_in_order) {
    auto visited = [](WallSet set, int count) {
        std::vector<int> walls;
        visit_walls(set, count, [&](int wall) { walls.push_back(wall); });
        return walls;
    };
    EXPECT_EQ(visited(0, 40), (std::vector<int>{}));
    EXPECT_EQ(visited(wall_bit(0) | wall_bit(7), 12), (std::vector<int>{0, 7}));
    EXPECT_EQ(visited(0xffff, 3), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(visited(wall_bit(3) | wall_bit(17), 19), (std::vector<int>{3, 15, 16, 17, 18}));
}

TEST(VisibleLights, seldom_need_the_exact_test) {
    Arena const arena = load_arena("collectball", "source");
    auto const& cells = arena.geometry->surroundings().cells;
    std::size_t mixed = 0;
    for (Surroundings::Cell const& cell : cells) mixed += static_cast<std::size_t>(std::popcount(cell.mixed));
    double const share = static_cast<double>(mixed) / static_cast<double>(cells.size() * arena.geometry->lights.size());
    EXPECT_LT(share, 0.05);
    EXPECT_GT(share, 0.001) << "shadows have edges";
}

}   // namespace
}   // namespace lore
