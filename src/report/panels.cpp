#include "panels.h"

#include <lore/arena_view/trajectory.h>
#include <lore/figure/trajectory.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace lore {

namespace {

/// Width or height of an SVG document.
double size_of(std::string const& svg, std::string_view which) {
    std::string const key = fmt::format(" {}=\"", which);
    std::size_t const at = svg.find(key) + key.size();
    double value = 0;
    std::from_chars(svg.data() + at, svg.data() + svg.size(), value);
    return value;
}

/// From the lowest to the highest value found; in an arena, whose rewards are balls, with 0.
void scale_panel(TrajectoryPicture& picture, bool arena, bool product) {
    std::vector<double> found = picture.values;
    std::erase_if(found, [](double value) { return std::isnan(value); });
    if (arena) found.push_back(0);
    if (!found.empty()) {
        auto const [least, most] = std::minmax_element(found.begin(), found.end());
        picture.lowest = *least;
        picture.highest = *most;
    }
    if (arena && picture.highest == picture.lowest) picture.highest = 1;   // a scale all the same
    // In an arena a window that is not found is worth -1, and makes a product 0; that is a place in the strip as long
    // as no value is negative.
    bool const has_place = arena && picture.lowest == 0;
    picture.not_found = !has_place ? std::numeric_limits<double>::quiet_NaN() : product ? 0 : -1;
}

/// Panel number `place` of the figure, without the trajectory itself.
TrajectoryPicture picture_of(CampaignPlan const& plan, PanelValues const& panel, std::size_t place,
                             Replay const& replay, bool arena) {
    bool const product = panel.knowledge.find('*') != std::string::npos;
    std::string const before =
        panel.figure == "figure5" ? fmt::format("({:c}) values from ", static_cast<char>('a' + static_cast<int>(place)))
                                  : "product of the values from ";
    TrajectoryPicture picture;
    picture.title = before + knowledge_label(plan, panel.knowledge);
    picture.values = panel.values;
    scale_panel(picture, arena, product);
    picture.value_label = product ? "product of the values" : fmt::format("value ({})", replay.reward_unit);
    picture.window_length = panel.window_length;
    return picture;
}

/// One document with the panels below each other.
std::string stacked(std::vector<std::string> const& panels) {
    double width = 0, height = 0;
    std::string body;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        std::string const panel = with_own_ids(panels[i], fmt::format("panel{}-", i + 1));
        width = std::max(width, size_of(panel, "width"));
        // Nested documents are placed by their own x and y.
        std::size_t const start = panel.find("<svg") + 4;
        body += fmt::format("<svg x=\"0\" y=\"{}\"{}", height, panel.substr(start));
        height += size_of(panel, "height");
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n{2}</svg>\n",
        width, height, body);
}

}   // namespace

std::string knowledge_label(CampaignPlan const& plan, std::string_view names) {
    std::string label;
    while (!names.empty()) {
        std::string_view const name = names.substr(0, names.find('*'));
        names.remove_prefix(std::min(names.size(), name.size() + 1));
        auto const planned = std::find_if(plan.knowledge.begin(), plan.knowledge.end(),
                                          [&](KnowledgePlan const& k) { return k.name == name; });
        if (!label.empty()) label += " \xc3\x97 ";
        label += planned == plan.knowledge.end() ? std::string{name} : planned->label;
    }
    return label;
}

std::string draw_panels(CampaignPlan const& plan, Results const& results, std::string_view figure) {
    if (results.replays.empty()) return "";
    Replay const& replay = results.replays.front();
    bool const arena = all_in_arenas(results.replays);
    std::vector<Pose> poses;
    std::vector<std::uint8_t> carrying;
    std::vector<Position> positions;
    for (std::size_t k = 0; k < replay.steps.size(); ++k) {
        ReplayStep const& step = replay.steps[k];
        positions.push_back({step.x, step.y});
        if (!arena) continue;
        poses.push_back({step.x, step.y, replay.arena->steps[k].theta});
        carrying.push_back(replay.arena->steps[k].carrying ? 1 : 0);
    }
    std::vector<std::string> panels;
    for (PanelValues const& panel : results.panels) {
        if (panel.figure != figure || panel.values.empty()) continue;
        TrajectoryPicture picture = picture_of(plan, panel, panels.size(), replay, arena);
        picture.positions = positions;
        panels.push_back(arena ? draw_trajectory(replay.arena->scene, RobotPath{poses, carrying}, picture)
                               : draw_trajectory(replay.scene, picture));
    }
    if (panels.size() < 2) return panels.empty() ? "" : panels.front();
    return stacked(panels);
}

std::string with_own_ids(std::string svg, std::string_view prefix) {
    for (std::string_view const before : {" id=\"", "url(#", "href=\"#", "aria-labelledby=\""}) {
        for (std::size_t at = svg.find(before); at != std::string::npos; at = svg.find(before, at + before.size()))
            svg.insert(at + before.size(), prefix);
    }
    return svg;
}

}   // namespace lore
