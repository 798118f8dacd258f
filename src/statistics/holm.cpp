#include <lore/statistics/holm.h>

#include <lore/core/error.h>

#include <algorithm>
#include <numeric>

namespace lore {

std::vector<double> holm_adjusted(std::span<double const> p_values) {
    for (double p : p_values)
        if (!(p >= 0 && p <= 1))
            throw Error("cannot correct p-values", "one lies outside 0 .. 1", "Check where they come from.");

    std::vector<std::size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });

    std::vector<double> adjusted(p_values.size());
    double least = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        double const multiple = p_values[order[k]] * static_cast<double>(order.size() - k);
        least = std::max(least, std::min(1.0, multiple));
        adjusted[order[k]] = least;
    }
    return adjusted;
}

}   // namespace lore
