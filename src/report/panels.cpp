#include "panels.h"

#include "html.h"

#include <lore/arena_view/trajectory.h>
#include <lore/figure/trajectory.h>

#include <algorithm>
#include <array>
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

/// From the lowest to the highest value found, with 0.
void scale_panel(TrajectoryPicture& picture, bool arena, bool product) {
    std::vector<double> found = picture.values;
    std::erase_if(found, [](double value) { return std::isnan(value); });
    found.push_back(0);
    auto const [least, most] = std::minmax_element(found.begin(), found.end());
    picture.lowest = *least;
    picture.highest = *most;
    // In an arena a window that is not found is worth -1, and makes a product 0; that is a place in the strip as long
    // as no value is negative.
    bool const has_place = arena && picture.lowest == 0;
    picture.not_found = !has_place ? std::numeric_limits<double>::quiet_NaN() : product ? 0 : -1;
}

/// "way" and 3 as "way" with a raised 3.
std::string power_of(std::string const& unit, std::ptrdiff_t exponent) {
    static constexpr std::array<std::string_view, 10> raised{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                             "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string text = unit;
    for (char const digit : std::to_string(exponent)) text += raised[static_cast<std::size_t>(digit - '0')];
    return text;
}

/// Panel number `place` of the figure, without the trajectory itself.
TrajectoryPicture picture_of(CampaignPlan const& plan, PanelValues const& panel, std::size_t place,
                             Replay const& replay, bool arena) {
    auto const factors = 1 + std::count(panel.knowledge.begin(), panel.knowledge.end(), '*');
    bool const product = factors > 1;
    std::string const before =
        panel.figure == "figure5" ? fmt::format("({:c}) values from ", static_cast<char>('a' + static_cast<int>(place)))
                                  : "product of the values from ";
    TrajectoryPicture picture;
    picture.title = before + knowledge_label(plan, panel.knowledge);
    picture.values = panel.values;
    scale_panel(picture, arena, product);
    picture.value_label = product ? fmt::format("product of the values ({})", power_of(replay.reward_unit, factors))
                                  : fmt::format("value ({})", replay.reward_unit);
    picture.window_length = panel.window_length;
    return picture;
}

/// One document with the panels below each other.
std::string stacked(std::vector<std::string> const& panels, std::string_view title) {
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
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                       "role=\"img\">\n<title>{2}</title>\n{3}</svg>\n",
                       width, height, escaped(title), body);
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

std::string panels_title(CampaignPlan const& plan, Results const& results, std::string_view figure) {
    std::string bases;
    for (PanelValues const& panel : results.panels)
        if (panel.figure == figure) bases += (bases.empty() ? "" : ", ") + knowledge_label(plan, panel.knowledge);
    return fmt::format("Path of the best-of-run of {}, colored by the {} {}", results.replays.front().run,
                       figure == "figure5" ? "values of" : "product of the values of", bases);
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
    return stacked(panels, panels_title(plan, results, figure));
}

std::string with_own_ids(std::string svg, std::string_view prefix) {
    for (std::string_view const before : {" id=\"", "url(#", "href=\"#", "aria-labelledby=\""}) {
        for (std::size_t at = svg.find(before); at != std::string::npos; at = svg.find(before, at + before.size()))
            svg.insert(at + before.size(), prefix);
    }
    return svg;
}

}   // namespace lore
