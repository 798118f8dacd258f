#pragma once

#include <span>
#include <vector>

namespace lore {

/// Holm's step-down correction (1979) of a family of p-values, in the order given.
///
/// The k-th smallest of m is multiplied by m - k + 1, made at least its predecessor, and cut at 1. Holds the chance of
/// any false rejection at the level tested, whatever the dependence between the tests. Throws Error for a value outside
/// [0, 1].
std::vector<double> holm_adjusted(std::span<double const> p_values);

}   // namespace lore
