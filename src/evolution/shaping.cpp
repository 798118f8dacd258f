#include <lore/evolution/shaping.h>

#include <lore/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lore {

namespace {

constexpr std::array<std::string_view, 3> use_names{"objective", "distance", "ties"};

}   // namespace

std::string_view name(ShapingUse use) { return use_names[static_cast<std::size_t>(use)]; }

ShapingUse shaping_use(std::string_view wanted) {
    auto const found = std::find(use_names.begin(), use_names.end(), wanted);
    if (found == use_names.end())
        throw UsageError(fmt::format("'{}' is not a use of shaping", wanted), "known are objective, distance, ties",
                         "Correct the name.");
    return static_cast<ShapingUse>(found - use_names.begin());
}

std::vector<double> shares(std::span<Individual const> pool, std::span<double const> values) {
    std::vector<std::uint32_t> showing(values.size(), 0);
    for (Individual const& member : pool)
        if (member.shown)
            for (std::uint32_t const feature : *member.shown) ++showing[feature];
    double const size = static_cast<double>(pool.size());
    std::vector<double> sums;
    for (Individual const& member : pool) {
        double sum = 0;
        if (member.shown)
            for (std::uint32_t const feature : *member.shown) sum += values[feature] * (1 - showing[feature] / size);
        sums.push_back(sum);
    }
    return sums;
}

}   // namespace lore
