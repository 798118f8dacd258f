#pragma once

#include <lore/figure/axis.h>
#include <lore/figure/scene.h>
#include <lore/figure/svg.h>
#include <lore/world/world.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// What a picture of one evaluation shows (paper, figures 5 and 6).
struct TrajectoryPicture {
    std::string title;
    std::span<Position const> positions;   ///< before the action of each step
    int window_length = 20;                ///< [steps]
    std::vector<double> values;            ///< per window; NaN: not in the knowledge base; may be empty
    double lowest = 0, highest = 1;        ///< ends of the color scale
    double not_found = -1;   ///< where the strip shows a window that is not in the knowledge base; NaN: at its bottom
    std::string value_label = "value";   ///< of color bar and strip, with the unit
};

/// Where a picture shows the places of a world.
struct PlanView {
    double scale = 1;   ///< [pixels/u]
    Axis x, y;
    SvgPoint place(float at_x, float at_y) const { return {x.at(at_x), y.at(at_y)}; }
};

/// The line that explains signs, written from left to right.
struct Legend {
    SvgDocument& svg;
    double x, y;   ///< of the middle of the next sign [pixels]
    /// The words after a sign, and room for the next.
    void entry(std::string_view words);
};

/// What a picture shows of a world besides the path.
class Backdrop {
public:
    virtual ~Backdrop() = default;
    virtual void paint_below(SvgDocument&, PlanView const&) const {}   ///< under the path
    virtual void paint_above(SvgDocument&, PlanView const&) const {}
    virtual void explain(Legend&) const {}
};

/// The backdrop, and on it the trajectory from pale (low values) to dark blue (high ones) with a dark outline, thin and
/// gray where a window was not found; below it the value over time. As an SVG document. `width` and `height`: of the
/// world [u].
std::string draw_trajectory(float width, float height, Backdrop const&, TrajectoryPicture const&);

/// The same over a world's scene, with start and end of the path.
std::string draw_trajectory(Scene const&, TrajectoryPicture const&);

}   // namespace lore
