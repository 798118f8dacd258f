#pragma once

#include <span>

namespace lore {

/// The quantile of a sample at `fraction` in [0, 1]: linear interpolation between the order statistics around position
/// fraction * (n - 1) (Hyndman and Fan's type 7, the default of R and NumPy).
///
/// Throws Error for an empty sample or one that holds a NaN.
double quantile(std::span<double const> sample, double fraction);

/// What a boxplot shows.
struct FiveNumbers {
    double low_whisker = 0;   ///< smallest value within 1.5 interquartile ranges of the lower quartile (Tukey)
    double lower_quartile = 0;
    double median = 0;
    double upper_quartile = 0;
    double high_whisker = 0;   ///< largest value within 1.5 interquartile ranges of the upper quartile
};
FiveNumbers five_numbers(std::span<double const> sample);

/// Sum in the order given over the count. Throws Error for an empty sample.
double mean(std::span<double const> sample);
/// Standard deviation with n - 1 below the root; 0 for a single value. Throws Error for an empty sample.
double standard_deviation(std::span<double const> sample);

}   // namespace lore
