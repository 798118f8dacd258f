#include <lore/statistics/quantiles.h>

#include <lore/core/error.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lore {

namespace {

std::vector<double> sorted(std::span<double const> sample) {
    if (sample.empty()) throw Error("cannot describe a sample", "it is empty", "Give at least one number.");
    std::vector<double> values{sample.begin(), sample.end()};
    if (std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }))
        throw Error("cannot describe a sample", "it holds a NaN", "Find out where it comes from.");
    std::sort(values.begin(), values.end());
    return values;
}

double quantile_of_sorted(std::vector<double> const& values, double fraction) {
    double const position = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(values.size() - 1);
    auto const below = static_cast<std::size_t>(position);
    if (below + 1 == values.size()) return values.back();
    return values[below] + (position - static_cast<double>(below)) * (values[below + 1] - values[below]);
}

}   // namespace

double quantile(std::span<double const> sample, double fraction) {
    return quantile_of_sorted(sorted(sample), fraction);
}

FiveNumbers five_numbers(std::span<double const> sample) {
    std::vector<double> const values = sorted(sample);
    FiveNumbers box;
    box.lower_quartile = quantile_of_sorted(values, 0.25);
    box.median = quantile_of_sorted(values, 0.5);
    box.upper_quartile = quantile_of_sorted(values, 0.75);
    double const reach = 1.5 * (box.upper_quartile - box.lower_quartile);
    box.low_whisker =
        *std::find_if(values.begin(), values.end(), [&](double x) { return x >= box.lower_quartile - reach; });
    box.high_whisker =
        *std::find_if(values.rbegin(), values.rend(), [&](double x) { return x <= box.upper_quartile + reach; });
    return box;
}

double mean(std::span<double const> sample) {
    if (sample.empty()) throw Error("cannot describe a sample", "it is empty", "Give at least one number.");
    double sum = 0;
    for (double x : sample) sum += x;
    return sum / static_cast<double>(sample.size());
}

double standard_deviation(std::span<double const> sample) {
    double const center = mean(sample);
    if (sample.size() == 1) return 0;
    double squares = 0;
    for (double x : sample) squares += (x - center) * (x - center);
    return std::sqrt(squares / static_cast<double>(sample.size() - 1));
}

}   // namespace lore
