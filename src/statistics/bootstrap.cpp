#include <lore/statistics/bootstrap.h>

#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/statistics/mann_whitney.h>
#include <lore/statistics/quantiles.h>

#include <algorithm>

namespace lore {

namespace {

using Sample = std::span<double const>;

/// Of what two samples say together, each drawn anew from itself.
Interval interval_of(double (*statistic)(Sample, Sample), Sample first, Sample second, BootstrapConfig const& config) {
    if (first.empty() || second.empty())
        throw Error("cannot draw samples anew", "one of them is empty", "Give at least one value of each.");
    std::vector<double> drawn[2], found;
    auto const draw = [&](Sample from, std::uint32_t resample, std::uint32_t which) {
        Stream rng{config.seed, Purpose::bootstrap, resample, 1 + which};
        drawn[which].resize(from.size());
        for (double& value : drawn[which]) value = from[rng.below(static_cast<std::uint32_t>(from.size()))];
    };
    for (int r = 0; r < std::max(1, config.resamples); ++r) {
        draw(first, static_cast<std::uint32_t>(r), 0);
        draw(second, static_cast<std::uint32_t>(r), 1);
        found.push_back(statistic(drawn[0], drawn[1]));
    }
    return {quantile(found, (1 - config.level) / 2), quantile(found, (1 + config.level) / 2)};
}

}   // namespace

MeanBand bootstrap_mean_band(std::span<std::vector<double> const> curves, BootstrapConfig const& config) {
    if (curves.empty()) throw Error("cannot band a mean curve", "there is no curve", "Give at least one run.");
    std::size_t const columns = curves.front().size();
    for (auto const& curve : curves)
        if (curve.size() != columns)
            throw Error("cannot band a mean curve", "the curves' lengths differ", "Cut them to the shortest.");

    // How often each run is drawn, decided once: columns of one draw belong to the same runs.
    std::size_t const runs = curves.size();
    auto const resamples = static_cast<std::size_t>(std::max(1, config.resamples));
    std::vector<double> times_drawn(resamples * runs, 0.0);
    for (std::size_t r = 0; r < resamples; ++r) {
        Stream rng{config.seed, Purpose::bootstrap, static_cast<std::uint32_t>(r)};
        for (std::size_t k = 0; k < runs; ++k) times_drawn[r * runs + rng.below(static_cast<std::uint32_t>(runs))] += 1;
    }

    MeanBand band;
    std::vector<double> column(runs), means(resamples);
    for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t k = 0; k < runs; ++k) column[k] = curves[k][c];
        for (std::size_t r = 0; r < resamples; ++r) {
            double sum = 0;
            for (std::size_t k = 0; k < runs; ++k) sum += times_drawn[r * runs + k] * column[k];
            means[r] = sum / static_cast<double>(runs);
        }
        band.mean.push_back(mean(column));
        band.low.push_back(quantile(means, (1 - config.level) / 2));
        band.high.push_back(quantile(means, (1 + config.level) / 2));
    }
    return band;
}

Interval bootstrap_mean_difference(std::span<double const> first, std::span<double const> second,
                                   BootstrapConfig const& config) {
    return interval_of([](Sample a, Sample b) { return mean(a) - mean(b); }, first, second, config);
}

Interval bootstrap_a12(std::span<double const> first, std::span<double const> second, BootstrapConfig const& config) {
    return interval_of(vargha_delaney_a12, first, second, config);
}

}   // namespace lore
