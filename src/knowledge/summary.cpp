#include <lore/knowledge/summary.h>

#include <algorithm>
#include <numeric>

namespace lore {

ValueSummary summarize(std::span<double const> values, int bins) {
    ValueSummary summary;
    if (values.empty()) return summary;
    auto const [low, high] = std::minmax_element(values.begin(), values.end());
    summary.lowest = *low;
    summary.highest = *high;
    summary.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    std::size_t const count = *low == *high ? 1 : static_cast<std::size_t>(bins);
    double const width = (*high - *low) / static_cast<double>(count);
    for (std::size_t edge = 0; edge <= count; ++edge)
        summary.edges.push_back(edge == count ? *high : *low + width * static_cast<double>(edge));
    summary.counts.assign(count, 0);
    for (double const value : values) {
        auto const bin = width > 0 ? static_cast<std::size_t>((value - *low) / width) : 0;
        ++summary.counts[std::min(bin, count - 1)];
    }
    return summary;
}

}   // namespace lore
