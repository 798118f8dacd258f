#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lore {

/// What the values of a knowledge base are like.
struct ValueSummary {
    double lowest = 0, highest = 0, mean = 0;   ///< all 0 of an empty base
    std::vector<double> edges;                  ///< of the histogram's bins, one more than bins
    std::vector<std::size_t> counts;            ///< [bin]; the last bin includes the highest value
};
/// Bins of equal width from the lowest to the highest value; one bin where these are equal, none for no values.
ValueSummary summarize(std::span<double const> values, int bins);

}   // namespace lore
