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

// Layout [pixels].
constexpr double usual_plan_width = 780, tallest_plan = 1200, left_margin = 66, top_margin = 46, title_height = 19,
                 right_margin = 106;
constexpr double bend = 0.3;   // too small to be seen
constexpr double axis_room = 48, strip_height = 130, bottom_margin = 52, legend_height = 26, shortest_bar = 60;

constexpr std::string_view ink = "#222222", pale = "#dddddd", gray = "#8c8c8c";

/// As wide as usual, unless that makes it too tall.
double plan_width(float width, float height) {
    double const ratio = static_cast<double>(height) / width;
    return ratio * usual_plan_width <= tallest_plan ? usual_plan_width : tallest_plan / ratio;
}

/// Pale to dark blue in steps of about equal lightness (Brewer's "Blues"); white would look as if it had no value.
std::string blue(double share) {
    static constexpr std::array<std::array<double, 3>, 6> stops{
        {{222, 235, 247}, {171, 208, 230}, {107, 174, 214}, {55, 135, 192}, {16, 91, 164}, {8, 48, 107}}};
    double const at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    std::size_t const i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    double const f = at - static_cast<double>(i);
    auto const mixed = [&](std::size_t c) {
        return static_cast<int>(std::lround(stops[i][c] * (1 - f) + stops[i + 1][c] * f));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

/// Of the widest label of an axis [pixels].
double label_width(double least, double most, int count) {
    std::size_t longest = 0;
    for (double const value : ticks(least, most, count)) longest = std::max(longest, tick_label(value).size());
    return 6.6 * static_cast<double>(longest);
}

/// The picture under construction: document, scales, and what is drawn.
class Painter {
public:
    Painter(float width, float height, Backdrop const& backdrop, TrajectoryPicture const& picture)
        : backdrop_(backdrop), picture_(picture),
          title_(broken_into_lines(picture.title, plan_width(width, height) + right_margin - 10, title_label)),
          plan_(plan_of(width, height, top_margin + title_height * (static_cast<double>(title_.size()) - 1))),
          plan_bottom_(plan_.y.last),
          svg_(left_margin + plan_width(width, height) + right_margin, this->height(), picture.title) {}

    std::string paint() && {
        svg_.text({left_margin, 28}, title_, title_height, title_label);
        svg_.begin_clip({plan_.x.first, plan_.y.first}, plan_.x.last - plan_.x.first, plan_.y.last - plan_.y.first);
        backdrop_.paint_below(svg_, plan_);
        paint_trajectory();
        backdrop_.paint_above(svg_, plan_);
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
    static constexpr Label title_label{.size = 15, .bold = true};

    static PlanView plan_of(float width, float height, double top) {
        double const wide = plan_width(width, height), scale = wide / width;
        return {scale, {0, width, left_margin, left_margin + wide}, {0, height, top, top + scale * height}};
    }
    double strip_top() const { return plan_bottom_ + axis_room + legend_height; }
    double height() const {
        return picture_.values.empty() ? plan_bottom_ + axis_room + legend_height
                                       : strip_top() + strip_height + bottom_margin;
    }
    SvgPoint at(std::size_t step) const { return plan_.place(picture_.positions[step].x, picture_.positions[step].y); }
    /// Where all values are equal they are at the low end of a scale of 1.
    double highest() const { return picture_.highest > picture_.lowest ? picture_.highest : picture_.lowest + 1; }
    double share(double value) const { return (value - picture_.lowest) / (highest() - picture_.lowest); }

    /// The way from one step to another, both included, in few points: a straight line leads from each to the farthest
    /// point for which all steps between lie on the line, as far as can be seen. This halves the document.
    std::vector<SvgPoint> path(std::size_t from, std::size_t to) const {
        std::vector<SvgPoint> points{at(from)};
        while (from < to) {
            std::size_t next = from + 1;
            while (next < to && straight(from, next + 1)) ++next;
            points.push_back(at(from = next));
        }
        return points;
    }
    bool straight(std::size_t from, std::size_t to) const {
        Position const &a = picture_.positions[from], &b = picture_.positions[to];
        double const dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
        for (std::size_t step = from + 1; step < to; ++step) {
            double const x = picture_.positions[step].x - a.x, y = picture_.positions[step].y - a.y;
            double const along = length2 > 0 ? std::clamp((x * dx + y * dy) / length2, 0.0, 1.0) : 0;
            if (plan_.scale * std::hypot(x - along * dx, y - along * dy) > bend) return false;
        }
        return true;
    }
    void paint_trajectory() {
        auto const length = static_cast<std::size_t>(picture_.window_length);
        for (std::size_t from = 0; from + 1 < picture_.positions.size(); from += length) {
            // One pose of the next window too, so that the line has no gaps.
            std::vector<SvgPoint> const points = path(from, std::min(from + length, picture_.positions.size() - 1));
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
        svg_.rect({plan_.x.first, plan_.y.first}, plan_.x.last - plan_.x.first, plan_.y.last - plan_.y.first,
                  {.stroke = ink});
        for (double const x : ticks(plan_.x.least, plan_.x.most, 6)) tick_x(plan_.x.at(x), plan_.y.last, tick_label(x));
        for (double const y : ticks(plan_.y.least, plan_.y.most, 4))
            tick_y(plan_.x.first, plan_.y.at(y), tick_label(y));
        svg_.text({(plan_.x.first + plan_.x.last) / 2, plan_.y.last + 36}, "x (u)", {.anchor = Anchor::middle});
        svg_.text({20, (plan_.y.first + plan_.y.last) / 2}, "y (u)", {.anchor = Anchor::middle, .rotation = -90});
    }

    void paint_legend() {
        Legend legend{svg_, plan_.x.first + 10, plan_bottom_ + axis_room + 8};
        backdrop_.explain(legend);
        if (picture_.values.empty()) return;
        svg_.line({legend.x - 6, legend.y}, {legend.x + 18, legend.y}, {.stroke = gray, .width = 1});
        legend.x += 24;
        legend.entry(std::isnan(picture_.not_found)
                         ? std::string{"not in the knowledge base"}
                         : fmt::format("not in the knowledge base ({})", tick_label(picture_.not_found)));
    }

    void paint_color_bar() {
        double const x = plan_.x.last + 24, top = plan_.y.first + 30,
                     bottom = std::max(plan_.y.last - 30, top + shortest_bar), width = 16;
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
        double const beside = std::max(46.0, label_width(axis.least, axis.most, 6) + 18);
        svg_.text({x + width + beside, (top + bottom) / 2}, picture_.value_label,
                  {.anchor = Anchor::middle, .rotation = -90});
    }

    void paint_strip() {
        double const top = strip_top(), bottom = top + strip_height;
        double const steps = static_cast<double>(picture_.positions.size());
        bool const at_bottom = std::isnan(picture_.not_found);   // where windows without a value are shown
        double least = at_bottom ? picture_.lowest : std::min(picture_.not_found, picture_.lowest), most = highest();
        double const room = 0.06 * (most - least);
        least -= room;
        most += room;
        Axis const time{0, steps, plan_.x.first, plan_.x.last}, value{least, most, bottom, top};
        int const count = static_cast<int>(std::clamp(most - least, 5.0, 8.0));   // -1 gets its mark
        for (double const v : ticks(least, most, count)) {
            svg_.line({plan_.x.first, value.at(v)}, {plan_.x.last, value.at(v)}, {.stroke = pale});
            tick_y(plan_.x.first, value.at(v), tick_label(v));
        }
        std::vector<SvgPoint> stairs;
        for (std::size_t window = 0; window < picture_.values.size(); ++window) {
            double const from = static_cast<double>(window) * picture_.window_length,
                         to = from + picture_.window_length;
            bool const found = !std::isnan(picture_.values[window]);
            double const y = value.at(found ? picture_.values[window] : at_bottom ? least : picture_.not_found);
            stairs.push_back({time.at(from), y});
            stairs.push_back({time.at(to), y});
            if (!found) svg_.line({time.at(from), y}, {time.at(to), y}, {.stroke = gray, .width = 5});
        }
        svg_.polyline(stairs, {.stroke = blue(0.85), .width = 1.2});
        svg_.rect({plan_.x.first, top}, plan_.x.last - plan_.x.first, strip_height, {.stroke = ink});
        for (double const step : ticks(0, steps, 8)) tick_x(time.at(step), bottom, tick_label(step));
        svg_.text({(plan_.x.first + plan_.x.last) / 2, bottom + 36}, "time (steps)", {.anchor = Anchor::middle});
        double const beside = std::min(20.0, plan_.x.first - 8 - label_width(least, most, count) - 8);
        svg_.text({beside, (top + bottom) / 2}, picture_.value_label, {.anchor = Anchor::middle, .rotation = -90});
    }

    Backdrop const& backdrop_;
    TrajectoryPicture const& picture_;
    std::vector<std::string> title_;   ///< its lines
    PlanView plan_;
    double plan_bottom_;   ///< [pixels]
    SvgDocument svg_;
};

/// The scene of a world, and where a path begins and ends in it.
class SceneBackdrop final : public Backdrop {
public:
    SceneBackdrop(Scene const& scene, std::span<Position const> path) : scene_(scene), path_(path) {}

    void paint_below(SvgDocument& svg, PlanView const& plan) const override {
        if (!scene_.svg.empty()) svg.embed({plan.x.first, plan.y.first}, plan.scale, scene_.svg);
    }
    void paint_above(SvgDocument& svg, PlanView const& plan) const override {
        if (path_.empty()) return;
        svg.circle(plan.place(path_.front().x, path_.front().y), 6, start_);
        SvgPoint const end = plan.place(path_.back().x, path_.back().y);
        svg.rect({end.x - 5, end.y - 5}, 10, 10, end_);
    }
    void explain(Legend& legend) const override {
        legend.svg.circle({legend.x, legend.y}, 6, start_);
        legend.x += 12;
        legend.entry("start");
        legend.svg.rect({legend.x - 5, legend.y - 5}, 10, 10, end_);
        legend.x += 12;
        legend.entry("end");
    }

private:
    static constexpr Paint start_{.fill = "#2f9e6e", .stroke = ink, .width = 1},
        end_{.fill = "#e0452f", .stroke = ink, .width = 1};
    Scene const& scene_;
    std::span<Position const> path_;
};

}   // namespace

void Legend::entry(std::string_view words) {
    constexpr Label label{.size = 11};
    svg.text({x, y + 4}, words, label);
    x += text_width(words, label) + 30;
}

std::string draw_trajectory(float width, float height, Backdrop const& backdrop, TrajectoryPicture const& picture) {
    assert(picture.window_length > 0);
    return Painter{width, height, backdrop, picture}.paint();
}

std::string draw_trajectory(Scene const& scene, TrajectoryPicture const& picture) {
    return draw_trajectory(scene.width, scene.height, SceneBackdrop{scene, picture.positions}, picture);
}

}   // namespace lore
