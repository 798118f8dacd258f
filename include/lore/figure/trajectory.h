#pragma once

#include <lore/figure/scene.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// What a picture of one evaluation shows (paper, figures 5 and 6).
struct TrajectoryPicture {
    std::string title;
    std::span<Pose const> poses;                 ///< before the move of each step
    std::span<std::uint8_t const> carrying;      ///< per step, 1 with a ball; as long as `poses`
    int window_length = 20;                      ///< [steps]
    std::vector<double> values;                  ///< per window; NaN: not in the knowledge base; may be empty
    double lowest = 0, highest = 1;              ///< ends of the color scale
    double not_found = -1;                       ///< where the strip shows a window that is not in the knowledge base
    std::string value_label = "value (balls)";   ///< of color bar and strip
};

/// The arena (walls dark, the door dashed, balls, basket with its lights, switch), the trajectory from white (low
/// values) to blue (high ones) with a dark outline, thin and gray where a window was not found, the robot every 50
/// steps, white or, with a ball, red; below it the value over time. As an SVG document.
std::string draw_trajectory(Scene const&, TrajectoryPicture const&);

}   // namespace lore
