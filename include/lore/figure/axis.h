#pragma once

#include <string>
#include <vector>

namespace lore {

/// Maps data to pixels along one axis; `first` may lie below or above `last` in pixels.
struct Axis {
    double least = 0, most = 1;   ///< data
    double first = 0, last = 1;   ///< pixels
    double at(double value) const { return first + (value - least) / (most - least) * (last - first); }
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within [least, most], about `count` of them.
std::vector<double> ticks(double least, double most, int count);

/// As a label: no more digits than needed.
std::string tick_label(double value);

}   // namespace lore
