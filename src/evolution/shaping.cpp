#include <lore/evolution/shaping.h>

#include <lore/core/names.h>

namespace lore {

namespace {

constexpr auto use_names = names_for<ShapingUse>("objective", "distance", "ties");

}   // namespace

std::string_view name(ShapingUse use) { return use_names[use]; }

ShapingUse shaping_use(std::string_view wanted) { return use_names.choice(wanted, "a use of shaping"); }

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
