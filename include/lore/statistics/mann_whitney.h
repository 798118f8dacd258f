#pragma once

#include <span>

namespace lore {

/// Samples without ties of at most this size each are compared by the exact distribution of U.
inline constexpr int exact_sample_limit = 100;

/// A two-sided Mann-Whitney test of two independent samples (paper, figure 4 and appendix).
struct MannWhitney {
    double u = 0;         ///< of the first sample: pairs in which it is larger, plus half the pairs that are equal
    double p = 1;         ///< two-sided, in [0, 1]
    bool exact = false;   ///< whether p comes from the exact distribution of U or from its normal approximation
};

/// Exact where no value occurs twice and neither sample exceeds exact_sample_limit; else the normal approximation with
/// the variance corrected for ties and a continuity correction of 1/2. Where all values are equal p is 1.
///
/// Throws Error for an empty sample or one that holds a NaN.
MannWhitney mann_whitney(std::span<double const> first, std::span<double const> second);

/// Vargha and Delaney's A12 (2000): the probability that a draw from `first` is larger than one from `second`, equal
/// draws counting half. 0.5: no effect; by their convention 0.56, 0.64 and 0.71 are small, medium and large effects.
///
/// Throws Error for an empty sample or one that holds a NaN.
double vargha_delaney_a12(std::span<double const> first, std::span<double const> second);

}   // namespace lore
