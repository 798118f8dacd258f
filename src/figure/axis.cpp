#include <lore/figure/axis.h>

#include <cmath>

#include <fmt/format.h>

namespace lore {

std::vector<double> ticks(double least, double most, int count) {
    double const rough = (most - least) / count;
    double const decade = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * decade;
    for (double const factor : {5.0, 2.0, 1.0})
        if (rough <= 1.5 * factor * decade) step = factor * decade;
    std::vector<double> places;
    for (double i = std::ceil(least / step - 1e-9); i * step <= most + 1e-9 * step; ++i) places.push_back(i * step);
    return places;
}

std::string tick_label(double value) { return std::abs(value) < 1e-12 ? "0" : fmt::format("{:.6g}", value); }

}   // namespace lore
