#include <lore/figure/trajectory.h>

#include <lore/figure/axis.h>
#include <lore/figure/svg.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr int steps_between_robots = 50;

// Layout [pixels].
constexpr double plan_width = 780, left_margin = 66, top_margin = 46, right_margin = 106;
constexpr double bend = 0.3;   // too small to be seen
constexpr double axis_room = 48, strip_height = 130, bottom_margin = 52, legend_height = 26;

constexpr std::string_view ink = "#222222", wall_color = "#3a3a3a", pale = "#dddddd", gray = "#8c8c8c",
                           ball_color = "#e8a800", basket_color = "#2f9e6e", robot_red = "#e0452f";

/// White to dark blue in steps of about equal lightness (Brewer's "Blues" with a white start).
std::string blue(double share) {
    static constexpr std::array<std::array<double, 3>, 7> stops{{{255, 255, 255},
                                                                 {222, 235, 247},
                                                                 {171, 208, 230},
                                                                 {107, 174, 214},
                                                                 {55, 135, 192},
                                                                 {16, 91, 164},
                                                                 {8, 48, 107}}};
    double const at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    std::size_t const i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    double const f = at - static_cast<double>(i);
    auto const mixed = [&](std::size_t c) {
        return static_cast<int>(std::lround(stops[i][c] * (1 - f) + stops[i + 1][c] * f));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

/// The picture under construction: document, scales, and what is drawn.
class Painter {
public:
    Painter(Scene const& scene, TrajectoryPicture const& picture)
        : scene_(scene), picture_(picture),
          scale_(plan_width / scene.width), x_{0, scene.width, left_margin, left_margin + plan_width},
          y_{0, scene.height, top_margin, top_margin + scale_ * scene.height},
          svg_(left_margin + plan_width + right_margin, height(), picture.title) {}

    std::string paint() && {
        svg_.text({left_margin, 28}, picture_.title, {.size = 15, .bold = true});
        svg_.begin_clip({x_.first, y_.first}, x_.last - x_.first, y_.last - y_.first);
        paint_basket();
        paint_robots();
        paint_walls();
        paint_trajectory();
        paint_lights();
        svg_.end_group();
        paint_axes();
        paint_legend();
        if (!picture_.values.empty()) {
            paint_color_bar();
            paint_strip();
        }
        return std::move(svg_).finish();
    }

private:
    double plan_bottom() const { return top_margin + scale_ * scene_.height; }
    double strip_top() const { return plan_bottom() + axis_room + legend_height; }
    double height() const {
        return picture_.values.empty() ? plan_bottom() + axis_room + legend_height
                                       : strip_top() + strip_height + bottom_margin;
    }
    SvgPoint place(float x, float y) const { return {x_.at(x), y_.at(y)}; }
    SvgPoint place(Point const& p) const { return place(p.x, p.y); }
    /// Where all values are equal they are at the low end of a scale of 1.
    double highest() const { return picture_.highest > picture_.lowest ? picture_.highest : picture_.lowest + 1; }
    double share(double value) const { return (value - picture_.lowest) / (highest() - picture_.lowest); }

    void paint_wall(Rect const& wall, Paint const& paint) {
        svg_.rect(place(wall.x0, wall.y0), (wall.x1 - wall.x0) * scale_, (wall.y1 - wall.y0) * scale_, paint);
    }
    void paint_walls() {
        for (Rect const& wall : scene_.walls) paint_wall(wall, {.fill = wall_color});
        for (Rect const& door : scene_.doors)
            paint_wall(door, {.fill = "#f2f2f2", .stroke = wall_color, .width = 1.2, .dashes = "5 3"});
    }
    void paint_basket() {
        svg_.circle(place(scene_.basket_center), scene_.basket_radius * scale_, {.fill = "#d9f0e5"});
    }
    /// Balls, basket lights and the switch, with names; above the trajectory, because they are small.
    void paint_lights() {
        bool const at_start = scene_.balls_at_start;
        for (Point const& ball : scene_.ball_positions) {
            if (!at_start) svg_.circle(place(ball), 11, {.stroke = ink, .width = 1, .dashes = "3 3"});
            svg_.circle(place(ball), 6, {.fill = ball_color, .stroke = ink, .width = 1});
        }
        svg_.circle(place(scene_.basket_center), scene_.basket_radius * scale_,
                    {.stroke = basket_color, .width = 1.4, .dashes = "4 3"});
        for (Point const& light : scene_.basket_lights)
            svg_.circle(place(light), 4, {.fill = basket_color, .stroke = ink, .width = 0.8});
        Point center{};
        for (Point const& light : scene_.basket_lights) center = {center.x + light.x, center.y + light.y};
        float const lights = static_cast<float>(scene_.basket_lights.size());
        name(place(center.x / lights, center.y / lights), "basket");
        SvgPoint const lamp = place(scene_.switch_position);
        svg_.rect({lamp.x - 6, lamp.y - 6}, 12, 12, {.fill = "#8e4fb0", .stroke = ink, .width = 1});
        name(lamp, "switch");
    }
    /// A name above a thing, legible over the trajectory.
    void name(SvgPoint const& at, std::string_view word) {
        double const width = 7.0 * static_cast<double>(word.size()) + 6;
        svg_.rect({at.x - width / 2, at.y - 25}, width, 15, {.fill = "#ffffff", .opacity = 0.8});
        svg_.text({at.x, at.y - 13.5}, word, {.anchor = Anchor::middle, .size = 11});
    }

    void paint_robots() {
        for (std::size_t step = 0; step < picture_.poses.size(); step += steps_between_robots)
            if (!stands_at(step))
                paint_robot(place(picture_.poses[step].x, picture_.poses[step].y), scene_.robot_radius * scale_,
                            picture_.poses[step].theta, picture_.carrying[step] != 0);
    }
    /// True if the robot has not moved since the last picture of it: discs one upon the other would hide that they are
    /// half transparent.
    bool stands_at(std::size_t step) const {
        if (step == 0) return false;
        Pose const &now = picture_.poses[step], &before = picture_.poses[step - steps_between_robots];
        bool const same_load = picture_.carrying[step] == picture_.carrying[step - steps_between_robots];
        return same_load && std::hypot(now.x - before.x, now.y - before.y) < 0.1 * scene_.robot_radius;
    }
    void paint_robot(SvgPoint const& at, double radius, double theta, bool carrying) {
        svg_.circle(at, radius, {.fill = carrying ? robot_red : "#ffffff", .opacity = carrying ? 0.45 : 0.6});
        svg_.circle(at, radius, {.stroke = "#555555", .width = 0.8});
        svg_.line(at, {at.x + radius * std::cos(theta), at.y + radius * std::sin(theta)},
                  {.stroke = "#555555", .width = 1.2});
    }

    /// The way from one step to another, both included, in few points: a straight line leads from each to the farthest
    /// point for which all steps between lie on the line, as far as can be seen. This halves the document.
    std::vector<SvgPoint> path(std::size_t from, std::size_t to) const {
        auto const at = [&](std::size_t step) { return place(picture_.poses[step].x, picture_.poses[step].y); };
        std::vector<SvgPoint> points{at(from)};
        while (from < to) {
            std::size_t next = from + 1;
            while (next < to && straight(from, next + 1)) ++next;
            points.push_back(at(from = next));
        }
        return points;
    }
    bool straight(std::size_t from, std::size_t to) const {
        Pose const &a = picture_.poses[from], &b = picture_.poses[to];
        double const dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
        for (std::size_t step = from + 1; step < to; ++step) {
            double const x = picture_.poses[step].x - a.x, y = picture_.poses[step].y - a.y;
            double const along = length2 > 0 ? std::clamp((x * dx + y * dy) / length2, 0.0, 1.0) : 0;
            if (scale_ * std::hypot(x - along * dx, y - along * dy) > bend) return false;
        }
        return true;
    }
    void paint_trajectory() {
        auto const length = static_cast<std::size_t>(picture_.window_length);
        for (std::size_t from = 0; from + 1 < picture_.poses.size(); from += length) {
            // One pose of the next window too, so that the line has no gaps.
            std::vector<SvgPoint> const points = path(from, std::min(from + length, picture_.poses.size() - 1));
            std::size_t const window = from / length;
            if (picture_.values.empty()) {
                svg_.polyline(points, {.stroke = blue(0.8), .width = 1.4});
            } else if (window >= picture_.values.size() || std::isnan(picture_.values[window])) {
                svg_.polyline(points, {.stroke = gray, .width = 1});
            } else {
                svg_.polyline(points, {.stroke = "#4d4d4d", .width = 4});
                svg_.polyline(points, {.stroke = blue(share(picture_.values[window])), .width = 2.8});
            }
        }
    }

    void tick_x(double x, double y, std::string const& label) {
        svg_.line({x, y}, {x, y + 5}, {.stroke = ink});
        svg_.text({x, y + 18}, label, {.anchor = Anchor::middle, .size = 11});
    }
    void tick_y(double x, double y, std::string const& label) {
        svg_.line({x - 5, y}, {x, y}, {.stroke = ink});
        svg_.text({x - 8, y + 4}, label, {.anchor = Anchor::end, .size = 11});
    }

    void paint_axes() {
        svg_.rect({x_.first, y_.first}, x_.last - x_.first, y_.last - y_.first, {.stroke = ink});
        for (double const x : ticks(x_.least, x_.most, 6)) tick_x(x_.at(x), y_.last, tick_label(x));
        for (double const y : ticks(y_.least, y_.most, 4)) tick_y(x_.first, y_.at(y), tick_label(y));
        svg_.text({(x_.first + x_.last) / 2, y_.last + 36}, "x (u)", {.anchor = Anchor::middle});
        svg_.text({20, (y_.first + y_.last) / 2}, "y (u)", {.anchor = Anchor::middle, .rotation = -90});
    }

    void paint_legend() {
        double const y = plan_bottom() + axis_room + 8;
        double x = x_.first + 10;
        auto const entry = [&](std::string_view word) {
            svg_.text({x, y + 4}, word, {.size = 11});
            x += 6.3 * static_cast<double>(word.size()) + 30;
        };
        for (bool const carrying : {false, true}) {
            paint_robot({x, y}, 8, 0, carrying);
            x += 14;
            entry(carrying ? "robot with a ball" : "robot, every 50 steps");
        }
        svg_.circle({x, y}, 6, {.fill = ball_color, .stroke = ink, .width = 1});
        x += 12;
        entry(scene_.balls_at_start ? "ball at the start" : "ball, after a press of the switch");
        if (!scene_.doors.empty()) {
            svg_.rect({x - 4, y - 7}, 8, 14, {.fill = "#f2f2f2", .stroke = wall_color, .width = 1.2, .dashes = "5 3"});
            x += 10;
            entry("door");
        }
        if (picture_.values.empty()) return;
        svg_.line({x - 6, y}, {x + 18, y}, {.stroke = gray, .width = 1});
        x += 24;
        entry(fmt::format("not in the knowledge base ({})", tick_label(picture_.not_found)));
    }

    void paint_color_bar() {
        double const x = x_.last + 24, top = y_.first + 30, bottom = y_.last - 30, width = 16;
        constexpr int slices = 64;
        Axis const axis{picture_.lowest, highest(), bottom, top};
        for (int i = 0; i < slices; ++i) {
            double const from = bottom + (top - bottom) * (i + 1) / slices, next = bottom + (top - bottom) * i / slices;
            svg_.rect({x, from}, width, next - from + (i > 0 ? 0.5 : 0), {.fill = blue((i + 0.5) / slices)});
        }
        svg_.rect({x, top}, width, bottom - top, {.stroke = ink});
        for (double const value : ticks(axis.least, axis.most, 6)) {
            svg_.line({x + width, axis.at(value)}, {x + width + 5, axis.at(value)}, {.stroke = ink});
            svg_.text({x + width + 8, axis.at(value) + 4}, tick_label(value), {.size = 11});
        }
        svg_.text({x + width + 46, (top + bottom) / 2}, picture_.value_label,
                  {.anchor = Anchor::middle, .rotation = -90});
    }

    void paint_strip() {
        double const top = strip_top(), bottom = top + strip_height;
        double const steps = static_cast<double>(picture_.poses.size());
        double least = std::min(picture_.not_found, picture_.lowest), most = highest();
        double const room = 0.06 * (most - least);
        least -= room;
        most += room;
        Axis const time{0, steps, x_.first, x_.last}, value{least, most, bottom, top};
        int const count = static_cast<int>(std::clamp(most - least, 5.0, 8.0));   // -1 gets its mark
        for (double const v : ticks(least, most, count)) {
            svg_.line({x_.first, value.at(v)}, {x_.last, value.at(v)}, {.stroke = pale});
            tick_y(x_.first, value.at(v), tick_label(v));
        }
        std::vector<SvgPoint> stairs;
        for (std::size_t window = 0; window < picture_.values.size(); ++window) {
            double const from = static_cast<double>(window) * picture_.window_length,
                         to = from + picture_.window_length;
            bool const found = !std::isnan(picture_.values[window]);
            double const y = value.at(found ? picture_.values[window] : picture_.not_found);
            stairs.push_back({time.at(from), y});
            stairs.push_back({time.at(to), y});
            if (!found) svg_.line({time.at(from), y}, {time.at(to), y}, {.stroke = gray, .width = 5});
        }
        svg_.polyline(stairs, {.stroke = blue(0.85), .width = 1.2});
        svg_.rect({x_.first, top}, x_.last - x_.first, strip_height, {.stroke = ink});
        for (double const step : ticks(0, steps, 8)) tick_x(time.at(step), bottom, tick_label(step));
        svg_.text({(x_.first + x_.last) / 2, bottom + 36}, "time (steps)", {.anchor = Anchor::middle});
        svg_.text({20, (top + bottom) / 2}, picture_.value_label, {.anchor = Anchor::middle, .rotation = -90});
    }

    Scene const& scene_;
    TrajectoryPicture const& picture_;
    double scale_;   ///< [pixels/u]
    Axis x_, y_;
    SvgDocument svg_;
};

}   // namespace

std::string draw_trajectory(Scene const& scene, TrajectoryPicture const& picture) {
    assert(picture.poses.size() == picture.carrying.size() && picture.window_length > 0);
    return Painter{scene, picture}.paint();
}

}   // namespace lore
