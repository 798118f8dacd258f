#include "run_cost.h"

#include <lore/core/progress.h>

#include <fmt/format.h>

#include <algorithm>

namespace lore {

namespace {

constexpr double long_enough = 0.5;   ///< to reckon with [s]

std::string short_time_text(double seconds) {
    return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

}   // namespace

std::string CostForecast::after(int generation, double now) {
    if (generation == 0) {
        first_ = 0;
        began_ = now;
    }
    double const elapsed = now - began_;
    if (told_ || generation == first_ || generation >= generations_ || elapsed < long_enough) return "";
    told_ = true;
    double const each = elapsed / (generation - first_);
    int const planned = generations_ - first_;
    return fmt::format("about {} for {} generations ({} each so far, on {} rank{}; later ones take more or less)",
                       duration_text(each * planned), planned, short_time_text(each), ranks_, ranks_ == 1 ? "" : "s");
}

std::string cost_report(std::vector<RankTimes> const& ranks, std::uint64_t steps, double seconds) {
    double processor = 0;
    for (RankTimes const& rank : ranks) processor += rank.processor;
    return fmt::format("cost: {:.1f} processor seconds, {} steps, {:.3g} million steps a second\n", processor, steps,
                       static_cast<double>(steps) / std::max(seconds, 1e-9) / 1e6);
}

}   // namespace lore
