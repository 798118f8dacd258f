#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lore {

struct BootstrapConfig {
    int resamples = 2000;
    double level = 0.95;      ///< coverage of the band
    std::uint64_t seed = 1;   ///< of Stream(seed, Purpose::bootstrap): the same band every time
};

/// A mean and its pointwise band; one entry a column.
struct MeanBand {
    std::vector<double> mean, low, high;
};

/// Mean of several curves, column by column, with the percentile bootstrap band of that mean (Efron 1979): whole curves
/// are drawn with replacement, and the quantiles (type 7) of the means of the draws bound the band.
///
/// `curves` are rows of equal length, one a run. A single curve has a band of no width. Throws Error without any curve
/// or if their lengths differ.
MeanBand bootstrap_mean_band(std::span<std::vector<double> const> curves, BootstrapConfig const& = {});

struct Interval {
    double low = 0, high = 0;
};

/// Percentile bootstrap interval of mean(first) - mean(second): both samples are drawn anew, each from itself. Throws
/// Error for an empty sample.
Interval bootstrap_mean_difference(std::span<double const> first, std::span<double const> second,
                                   BootstrapConfig const& = {});

/// Percentile bootstrap interval of vargha_delaney_a12: both samples are drawn anew, each from itself. Of no width
/// where no value of one sample lies among those of the other. Throws Error for an empty sample or one that holds a
/// NaN.
Interval bootstrap_a12(std::span<double const> first, std::span<double const> second, BootstrapConfig const& = {});

}   // namespace lore
