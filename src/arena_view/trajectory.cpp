#include <lore/arena_view/trajectory.h>

#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

namespace lore {

namespace {

constexpr int steps_between_robots = 50;

constexpr std::string_view ink = "#222222", wall_color = "#3a3a3a", ball_color = "#e8a800", basket_color = "#2f9e6e",
                           robot_red = "#e0452f";
constexpr Paint door_paint{.fill = "#f2f2f2", .stroke = wall_color, .width = 1.2, .dashes = "5 3"};

SvgPoint place(PlanView const& plan, Point const& p) { return plan.place(p.x, p.y); }

void paint_wall(SvgDocument& svg, PlanView const& plan, Rect const& wall, Paint const& paint) {
    svg.rect(plan.place(wall.x0, wall.y0), (wall.x1 - wall.x0) * plan.scale, (wall.y1 - wall.y0) * plan.scale, paint);
}

/// A name above a thing, legible over the trajectory.
void name(SvgDocument& svg, SvgPoint const& at, std::string_view word) {
    double const width = 7.0 * static_cast<double>(word.size()) + 6;
    svg.rect({at.x - width / 2, at.y - 25}, width, 15, {.fill = "#ffffff", .opacity = 0.8});
    svg.text({at.x, at.y - 13.5}, word, {.anchor = Anchor::middle, .size = 11});
}

void paint_robot(SvgDocument& svg, SvgPoint const& at, double radius, double theta, bool carrying) {
    svg.circle(at, radius, {.fill = carrying ? robot_red : "#ffffff", .opacity = carrying ? 0.45 : 0.6});
    svg.circle(at, radius, {.stroke = "#555555", .width = 0.8});
    svg.line(at, {at.x + radius * std::cos(theta), at.y + radius * std::sin(theta)},
             {.stroke = "#555555", .width = 1.2});
}

class ArenaBackdrop final : public Backdrop {
public:
    ArenaBackdrop(ArenaScene const& scene, RobotPath const& path) : scene_(scene), path_(path) {}

    void paint_below(SvgDocument& svg, PlanView const& plan) const override {
        svg.circle(place(plan, scene_.basket_center), scene_.basket_radius * plan.scale, {.fill = "#d9f0e5"});
        for (std::size_t step = 0; step < path_.poses.size(); step += steps_between_robots)
            if (!stands_at(step))
                paint_robot(svg, plan.place(path_.poses[step].x, path_.poses[step].y), scene_.robot_radius * plan.scale,
                            path_.poses[step].theta, path_.carrying[step] != 0);
        for (Rect const& wall : scene_.walls) paint_wall(svg, plan, wall, {.fill = wall_color});
        for (Rect const& door : scene_.doors) paint_wall(svg, plan, door, door_paint);
    }

    /// Balls, basket lights and the switch, with names; above the trajectory, because they are small.
    void paint_above(SvgDocument& svg, PlanView const& plan) const override {
        for (Point const& ball : scene_.ball_positions) {
            if (!scene_.balls_at_start) svg.circle(place(plan, ball), 11, {.stroke = ink, .width = 1, .dashes = "3 3"});
            svg.circle(place(plan, ball), 6, {.fill = ball_color, .stroke = ink, .width = 1});
        }
        svg.circle(place(plan, scene_.basket_center), scene_.basket_radius * plan.scale,
                   {.stroke = basket_color, .width = 1.4, .dashes = "4 3"});
        for (Point const& light : scene_.basket_lights)
            svg.circle(place(plan, light), 4, {.fill = basket_color, .stroke = ink, .width = 0.8});
        Point center{};
        for (Point const& light : scene_.basket_lights) center = {center.x + light.x, center.y + light.y};
        float const lights = static_cast<float>(scene_.basket_lights.size());
        name(svg, plan.place(center.x / lights, center.y / lights), "basket");
        SvgPoint const lamp = place(plan, scene_.switch_position);
        svg.rect({lamp.x - 6, lamp.y - 6}, 12, 12, {.fill = "#8e4fb0", .stroke = ink, .width = 1});
        name(svg, lamp, "switch");
    }

    void explain(Legend& legend) const override {
        for (bool const carrying : {false, true}) {
            paint_robot(legend.svg, {legend.x, legend.y}, 8, 0, carrying);
            legend.x += 14;
            legend.entry(carrying ? "robot with a ball" : "robot, every 50 steps");
        }
        legend.svg.circle({legend.x, legend.y}, 6, {.fill = ball_color, .stroke = ink, .width = 1});
        legend.x += 12;
        legend.entry(scene_.balls_at_start ? "ball at the start" : "ball, after a press of the switch");
        if (scene_.doors.empty()) return;
        legend.svg.rect({legend.x - 4, legend.y - 7}, 8, 14, door_paint);
        legend.x += 10;
        legend.entry("door");
    }

private:
    /// True if the robot has not moved since the last picture of it: discs one upon the other would hide that they are
    /// half transparent.
    bool stands_at(std::size_t step) const {
        if (step == 0) return false;
        Pose const &now = path_.poses[step], &before = path_.poses[step - steps_between_robots];
        bool const same_load = path_.carrying[step] == path_.carrying[step - steps_between_robots];
        return same_load && std::hypot(now.x - before.x, now.y - before.y) < 0.1 * scene_.robot_radius;
    }

    ArenaScene const& scene_;
    RobotPath const& path_;
};

}   // namespace

std::string draw_trajectory(ArenaScene const& scene, RobotPath const& path, TrajectoryPicture picture) {
    assert(path.poses.size() == path.carrying.size());
    std::vector<Position> positions;
    for (Pose const& pose : path.poses) positions.push_back({pose.x, pose.y});
    picture.positions = positions;
    return draw_trajectory(scene.width, scene.height, ArenaBackdrop{scene, path}, picture);
}

}   // namespace lore
