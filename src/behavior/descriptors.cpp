#include <lore/behavior/descriptors.h>

#include <lore/core/math.h>

#include <algorithm>
#include <cassert>

namespace lore {

namespace {

/// log c for the counts that an evaluation of usual length can give.
double log_of_count(std::uint32_t count) {
    static auto const table = [] {
        std::array<double, 4097> logs{};
        for (std::size_t c = 1; c < logs.size(); ++c) logs[c] = math::log(static_cast<double>(c));
        return logs;
    }();
    return count < table.size() ? table[count] : math::log(static_cast<double>(count));
}

/// Entropy in base (number of bins). Written with log(steps) - log(count), so that it is exactly 0 where one bin holds
/// all, which is the everyday case of the binary channels.
template <std::size_t bins>
double entropy(std::array<std::uint32_t, bins> const& counts, int steps) {
    double const log_steps = log_of_count(static_cast<std::uint32_t>(steps));
    double sum = 0;
    for (std::uint32_t const count : counts)
        if (count > 0) sum += count * (log_steps - log_of_count(count));
    return sum / (steps * log_of_count(bins));
}

ChannelHistograms histograms_of(Trace const& trace) {
    ChannelHistograms histograms{trace.channels};
    std::size_t const words = static_cast<std::size_t>(trace.channels.words());
    auto bits = trace.channel_bits.begin();
    auto values = trace.values.begin();
    for (int step = 0; step < trace.steps(); ++step, bits += static_cast<std::ptrdiff_t>(words)) {
        for (std::size_t b = 0; b < histograms.ones.size(); ++b)
            histograms.ones[b] += static_cast<std::uint32_t>(bits[static_cast<std::ptrdiff_t>(b / 16)] >> b % 16) & 1u;
        for (auto& counts : histograms.continuous) ++counts[static_cast<std::size_t>(entropy_bin(*values++))];
    }
    return histograms;
}

}   // namespace

Tile tile_of(WorldFacts const& facts, float x, float y) {
    float const side = std::max(facts.width, facts.height);
    assert(x >= 0 && x <= side && y >= 0 && y <= side);
    auto const tile = [&](float place) {
        return static_cast<std::uint8_t>(std::min(static_cast<int>(tiles_per_side * place / side), tiles_per_side - 1));
    };
    return {tile(x), tile(y)};
}

std::vector<double> entropies(Channels const& channels, ChannelHistograms const& histograms, int steps) {
    std::vector<double> result(static_cast<std::size_t>(channels.count()));
    if (steps == 0) return result;
    for (std::size_t c = 0; c < histograms.continuous.size(); ++c)
        result[static_cast<std::size_t>(channels.continuous()[c])] = entropy(histograms.continuous[c], steps);
    for (std::size_t c = 0; c < histograms.ones.size(); ++c) {
        std::uint32_t const ones = histograms.ones[c];
        result[static_cast<std::size_t>(channels.binary()[c])] =
            entropy<2>({static_cast<std::uint32_t>(steps) - ones, ones}, steps);
    }
    return result;
}

Descriptors describe(WorldFacts const& facts, Trace const& trace) {
    Descriptors d;
    d.outcome = trace.outcome;
    d.channel_bits = trace.channel_bits;
    for (std::size_t step = 0; step < trace.positions.size(); step += steps_per_tile_sample)
        d.path.push_back(tile_of(facts, trace.positions[step].x, trace.positions[step].y));
    d.entropies = entropies(trace.channels, histograms_of(trace), trace.steps());
    return d;
}

}   // namespace lore
