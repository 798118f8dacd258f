#include <lore/collectball/mechanics.h>

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lore {
namespace {

constexpr double pi = 3.14159265358979323846;

mechanics::Vector<float> arc_of(float left, float right, float theta) {
    return mechanics::arc(mechanics::drive(left, right, 4.0f, 1.0f / 40.0f), math::sincos(theta));
}

TEST(Arc, goes_straight_when_both_wheels_agree) {
    auto const way = arc_of(1.0f, 1.0f, 0.0f);
    EXPECT_FLOAT_EQ(way.x, 4.0f);
    EXPECT_FLOAT_EQ(way.y, 0.0f);
}

TEST(Arc, goes_backwards_with_outputs_of_zero) {
    auto const way = arc_of(0.0f, 0.0f, 0.0f);
    EXPECT_FLOAT_EQ(way.x, -4.0f);
}

TEST(Arc, turns_on_the_spot_with_opposite_wheels) {
    auto const drive = mechanics::drive(0.0f, 1.0f, 4.0f, 1.0f / 40.0f);
    EXPECT_FLOAT_EQ(drive.turn, 0.2f);   // (4 - -4) / 40
    EXPECT_FLOAT_EQ(drive.way, 0.0f);
    auto const way = mechanics::arc(drive, math::sincos(1.0f));
    EXPECT_FLOAT_EQ(way.x, 0.0f);
    EXPECT_FLOAT_EQ(way.y, 0.0f);
}

TEST(Arc, follows_the_circle_around_a_standing_wheel) {
    // Left wheel still: the center goes around it on a circle of 20 u by 0.1 rad; +y is to the right of heading 0, so
    // the faster right wheel, which turns the heading towards +y, is the one on the -y side.
    auto const way = arc_of(0.5f, 1.0f, 0.0f);
    EXPECT_NEAR(way.x, 20 * std::sin(0.1), 1e-6);
    EXPECT_NEAR(way.y, 20 * (1 - std::cos(0.1)), 1e-6);
}

TEST(Arc, is_the_textbook_formula_to_float_accuracy_for_any_wheels_and_heading) {
    Stream rng{1, Purpose::test};
    for (int i = 0; i < 2000; ++i) {
        float const left = static_cast<float>(rng.uniform()), right = static_cast<float>(rng.uniform());
        float const theta = static_cast<float>(rng.uniform(-pi, pi));
        auto const way =
            mechanics::arc(mechanics::drive(left, right, 10.0f, 1.0f / 40.0f), math::sincos(theta));   // up to 0.5 rad
        double const dl = 10.0 * (2.0 * left - 1), dr = 10.0 * (2.0 * right - 1), a = (dr - dl) / 40;
        double const r = dl / a + 20, u = (std::cos(a) - 1) * r, v = std::sin(a) * r;
        double const rotation = theta - pi / 2;
        EXPECT_NEAR(way.x, u * std::cos(rotation) - v * std::sin(rotation), 3e-6);
        EXPECT_NEAR(way.y, u * std::sin(rotation) + v * std::cos(rotation), 3e-6);
    }
}

TEST(Wrap, keeps_headings_between_minus_pi_and_pi) {
    EXPECT_FLOAT_EQ(mechanics::wrap(3.0f), 3.0f);
    EXPECT_FLOAT_EQ(mechanics::wrap(3.2f), 3.2f - 6.2831853f);
    EXPECT_FLOAT_EQ(mechanics::wrap(-3.2f), -3.2f + 6.2831853f);
    EXPECT_EQ(mechanics::wrap(math::pi), math::pi);
    float theta = 0;
    for (int i = 0; i < 100000; ++i) {
        theta = mechanics::wrap(theta + 0.37f);
        ASSERT_GE(theta, -math::pi);
        ASSERT_LE(theta, math::pi);
    }
}

TEST(Contact, is_strict_at_the_radius) {
    Rect const wall{100, 110, 0, 50};
    EXPECT_FALSE(mechanics::touches(wall, 80.0f, 25.0f, 400.0f));
    EXPECT_TRUE(mechanics::touches(wall, 80.001f, 25.0f, 400.0f));
    // 12, 16, 20: the corner (100, 50) at exactly the radius.
    EXPECT_FALSE(mechanics::touches(wall, 88.0f, 66.0f, 400.0f));
    EXPECT_TRUE(mechanics::touches(wall, 88.0f, 65.99f, 400.0f));
    EXPECT_TRUE(mechanics::touches(wall, 105.0f, 25.0f, 400.0f)) << "center inside the wall";
}

TEST(SegmentMeets, a_wall_that_it_crosses_touches_or_lies_in) {
    Rect const wall{10, 20, 10, 20};
    auto const meets = [&](float px, float py, float qx, float qy) {
        return mechanics::segment_meets(wall, px, py, qx, qy) != 0;
    };
    EXPECT_TRUE(meets(0, 15, 30, 15));
    EXPECT_TRUE(meets(12, 12, 13, 13));
    EXPECT_TRUE(meets(0, 10, 30, 10)) << "along the edge: closed";
    EXPECT_TRUE(meets(5, 15, 15, 5)) << "through the corner (10, 10): closed";
    EXPECT_FALSE(meets(0, 15, 9.99f, 15)) << "ends before it";
    EXPECT_FALSE(meets(21, 0, 21, 30));
    EXPECT_FALSE(meets(5, 14.9f, 14.9f, 5)) << "passes the corner";
}

TEST(Bumpers, of_a_flush_wall_ahead_are_both_pressed) {
    auto const pressed = mechanics::bumpers(Rect{119, 130, 0, 200}, 100.0f, 100.0f, math::sincos(0.0f), 20.0f);
    EXPECT_TRUE(pressed.right);
    EXPECT_TRUE(pressed.left);
}

TEST(Bumpers, of_a_wall_behind_are_not_pressed) {
    auto const pressed = mechanics::bumpers(Rect{70, 81, 0, 200}, 100.0f, 100.0f, math::sincos(0.0f), 20.0f);
    EXPECT_FALSE(pressed.right);
    EXPECT_FALSE(pressed.left);
}

TEST(Bumpers, right_is_the_side_of_positive_bearing) {
    // y grows downwards: a post below the robot's way is at its right.
    auto const right = mechanics::bumpers(Rect{112, 114, 112, 114}, 100.0f, 100.0f, math::sincos(0.0f), 20.0f);
    EXPECT_TRUE(right.right);
    EXPECT_FALSE(right.left);
    auto const left = mechanics::bumpers(Rect{112, 114, 86, 88}, 100.0f, 100.0f, math::sincos(0.0f), 20.0f);
    EXPECT_FALSE(left.right);
    EXPECT_TRUE(left.left);
}

TEST(Bumpers, need_more_than_the_nearest_point_of_a_wall) {
    // The nearest point of a wall at bearing 80 degrees is in the right sector, but turned by 100 degrees it is behind
    // the +90 degree ray, while the wall still reaches into the sector across that ray.
    float const heading = static_cast<float>(-10 * pi / 180);
    auto const pressed = mechanics::bumpers(Rect{0, 200, 115, 130}, 100.0f, 100.0f, math::sincos(heading), 20.0f);
    EXPECT_TRUE(pressed.right);
    EXPECT_FALSE(pressed.left);
}

TEST(Bumpers, of_a_wall_that_ends_exactly_straight_ahead_are_pressed_on_its_side_only) {
    auto const pressed = mechanics::bumpers(Rect{115, 130, 100, 200}, 100.0f, 100.0f, math::sincos(0.0f), 20.0f);
    EXPECT_TRUE(pressed.right);
    EXPECT_FALSE(pressed.left) << "its bearings begin at 0, and 0 is no side";
}

TEST(Bumpers, agree_with_sampled_wall_points_wherever_the_samples_can_tell) {
    Stream rng{2, Purpose::test};
    int decided = 0;
    for (int i = 0; i < 3000; ++i) {
        double const x0 = rng.uniform(-30, 25), y0 = rng.uniform(-30, 25), w = rng.uniform(1, 30),
                     h = rng.uniform(1, 30);
        Rect const wall{static_cast<float>(x0), static_cast<float>(x0 + w), static_cast<float>(y0),
                        static_cast<float>(y0 + h)};
        float const theta = static_cast<float>(rng.uniform(-pi, pi));
        bool const holds_center = x0 <= 0 && x0 + w >= 0 && y0 <= 0 && y0 + h >= 0;
        if (holds_center || !mechanics::touches(wall, 0.0f, 0.0f, 400.0f)) continue;
        auto const pressed = mechanics::bumpers(wall, 0.0f, 0.0f, math::sincos(theta), 20.0f);
        bool surely[2]{}, possibly[2]{};   // by points well inside the sector, or not well outside of it
        for (double fx = 0; fx <= 1; fx += 0.02)
            for (double fy = 0; fy <= 1; fy += 0.02) {
                double const px = x0 + fx * w, py = y0 + fy * h;
                double const forward = px * std::cos(theta) + py * std::sin(theta);
                double const right = py * std::cos(theta) - px * std::sin(theta);
                double const distance = std::hypot(px, py);
                for (int side = 0; side < 2; ++side) {
                    double const sideways = side == 0 ? right : -right;
                    surely[side] |= forward > 0 && sideways > 0 && distance < 20;
                    possibly[side] |= forward > -1 && sideways > -1 && distance < 21;
                }
            }
        bool const ours[2]{pressed.right != 0, pressed.left != 0};
        for (int side = 0; side < 2; ++side) {
            EXPECT_TRUE(ours[side] || !surely[side]) << i;
            EXPECT_TRUE(!ours[side] || possibly[side]) << i;
            decided += surely[side] == possibly[side];
        }
    }
    EXPECT_GT(decided, 2000);
}

TEST(Ray, hits_the_face_that_looks_at_it) {
    FacePair const faces{50, 60, 0, 100, false};   // a wall from x = 50 to 60
    auto const forward = mechanics::ray(mechanics::Vector<float>{1, 0});
    auto const backward = mechanics::ray(mechanics::Vector<float>{-1, 0});
    EXPECT_EQ(mechanics::hit_vertical(faces, 10.0f, 50.0f, forward, 1000.0f), 40.0f);
    EXPECT_EQ(mechanics::hit_vertical(faces, 100.0f, 50.0f, backward, 1000.0f), 40.0f);
    EXPECT_EQ(mechanics::hit_vertical(faces, 10.0f, 50.0f, backward, 1000.0f), 1000.0f) << "looks away";
    EXPECT_EQ(mechanics::hit_vertical(faces, 10.0f, 50.0f, forward, 30.0f), 30.0f) << "something nearer was hit";
    EXPECT_EQ(mechanics::hit_vertical(faces, 10.0f, 100.0f, forward, 1000.0f), 40.0f)
        << "the end of a face belongs to it";
    EXPECT_EQ(mechanics::hit_vertical(faces, 10.0f, 100.001f, forward, 1000.0f), 1000.0f);
}

TEST(Ray, parallel_to_a_face_does_not_hit_it_wherever_it_starts) {
    FacePair const faces{50, 60, 0, 100, false};
    for (float const zero : {0.0f, -0.0f})
        for (float const along : {1.0f, -1.0f})
            for (float const x : {10.0f, 50.0f, 60.0f, 70.0f}) {
                auto const ray = mechanics::ray(mechanics::Vector<float>{zero, along});
                EXPECT_EQ(mechanics::hit_vertical(faces, x, 50.0f, ray, 1000.0f), 1000.0f);
            }
}

TEST(Ray, never_hits_a_face_that_is_not_there) {
    float const infinity = std::numeric_limits<float>::infinity();
    FacePair const none{infinity, infinity, 0, 100, false};
    for (float const dx : {1.0f, -1.0f, 0.0f, 0.6f})
        for (float const dy : {0.8f, -1.0f, 0.0f}) {
            auto const ray = mechanics::ray(mechanics::Vector<float>{dx, dy});
            EXPECT_EQ(mechanics::hit_vertical(none, 10.0f, 50.0f, ray, 1000.0f), 1000.0f);
            EXPECT_EQ(mechanics::hit_horizontal(none, 10.0f, 50.0f, ray, 1000.0f), 1000.0f);
        }
}

TEST(RangeValue, falls_from_one_at_the_wall_to_zero_at_the_range) {
    auto const value = [](float distance) { return mechanics::range_value(distance, 320.0f, 1.0f / 320.0f); };
    EXPECT_EQ(value(0.0f), 1.0f);
    EXPECT_EQ(value(160.0f), 0.5f);
    EXPECT_EQ(value(320.0f), 0.0f);
    EXPECT_EQ(value(std::numeric_limits<float>::infinity()), 0.0f);
    for (float const range : {1.0f, 3.0f, 7.0f, 49.0f, 321.7f})
        EXPECT_GE(mechanics::range_value(std::nextafter(range, 0.0f), range, 1.0f / range), 0.0f);
}

TEST(InView, is_half_the_field_of_view_on_either_side) {
    float const half = 0.79039818f;   // (pi/2 + 0.01) / 2
    float const cosine = math::sincos(half).cos;
    auto const seen = [&](double bearing) {
        return mechanics::in_view(static_cast<float>(100 * std::cos(bearing)),
                                  static_cast<float>(100 * std::sin(bearing)), mechanics::Vector<float>{1, 0},
                                  cosine * cosine) != 0;
    };
    EXPECT_TRUE(seen(0));
    EXPECT_TRUE(seen(half - 1e-4));
    EXPECT_TRUE(seen(-half + 1e-4));
    EXPECT_FALSE(seen(half + 1e-4));
    EXPECT_FALSE(seen(-half - 1e-4));
    EXPECT_FALSE(seen(pi)) << "squares must not make behind look like ahead";
    EXPECT_FALSE(mechanics::in_view(0.0f, 0.0f, mechanics::Vector<float>{1, 0}, cosine * cosine))
        << "a light at the center has no bearing";
}

TEST(Mechanics, give_the_same_bits_in_a_vector_as_alone) {
    using V = Lanes<float, 4>;
    Stream rng{3, Purpose::test};
    Rect const wall{100, 130, 80, 140};
    FacePair const faces{100, 130, 80, 140, false};
    for (int round = 0; round < 2000; ++round) {
        V x{}, y{}, theta{}, left{}, right{};
        for (int i = 0; i < 4; ++i) {
            x[i] = static_cast<float>(rng.uniform(60, 170));
            y[i] = static_cast<float>(rng.uniform(40, 180));
            theta[i] = static_cast<float>(round % 50 == 0 ? (i - 2) * pi / 2 : rng.uniform(-pi, pi));
            left[i] = static_cast<float>(rng.uniform());
            right[i] = round % 10 == 0 ? left[i] : static_cast<float>(rng.uniform());
        }
        auto const heading = math::sincos(theta);
        auto const drive = mechanics::drive(left, right, 4.0f, 1.0f / 40.0f);
        auto const way = mechanics::arc(drive, heading);
        V const wrapped = mechanics::wrap(theta + drive.turn);
        auto const touched = mechanics::touches(wall, x, y, 400.0f);
        auto const pressed = mechanics::bumpers(wall, x, y, heading, 20.0f);
        auto const ray = mechanics::ray(mechanics::directions(heading).left);
        V const far = V{} + 320.0f;
        V const hit = mechanics::hit_horizontal(faces, x, y, ray, mechanics::hit_vertical(faces, x, y, ray, far));
        V const value = mechanics::range_value(hit, 320.0f, 1.0f / 320.0f);
        auto const seen = mechanics::in_view(x, y, mechanics::directions(heading).right, 0.4950f);
        for (int i = 0; i < 4; ++i) {
            auto const h = math::sincos(float{theta[i]});
            auto const d = mechanics::drive(float{left[i]}, float{right[i]}, 4.0f, 1.0f / 40.0f);
            auto const w = mechanics::arc(d, h);
            EXPECT_EQ(w.x, way.x[i]);
            EXPECT_EQ(w.y, way.y[i]);
            EXPECT_EQ(mechanics::wrap(float{theta[i]} + d.turn), wrapped[i]);
            EXPECT_EQ(mechanics::touches(wall, float{x[i]}, float{y[i]}, 400.0f), touched[i] != 0);
            auto const p = mechanics::bumpers(wall, float{x[i]}, float{y[i]}, h, 20.0f);
            EXPECT_EQ(p.right != 0, pressed.right[i] != 0);
            EXPECT_EQ(p.left != 0, pressed.left[i] != 0);
            auto const r = mechanics::ray(mechanics::directions(h).left);
            float const t =
                mechanics::hit_horizontal(faces, float{x[i]}, float{y[i]}, r,
                                          mechanics::hit_vertical(faces, float{x[i]}, float{y[i]}, r, 320.0f));
            EXPECT_EQ(t, hit[i]);
            EXPECT_EQ(mechanics::range_value(t, 320.0f, 1.0f / 320.0f), value[i]);
            EXPECT_EQ(mechanics::in_view(float{x[i]}, float{y[i]}, mechanics::directions(h).right, 0.4950f) != 0,
                      seen[i] != 0);
        }
    }
}

}   // namespace
}   // namespace lore
