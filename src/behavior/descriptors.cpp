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
    ChannelHistograms histograms;
    for (int step = 0; step < trace.steps(); ++step) {
        for (int c = 0; c < binary_count; ++c) histograms.ones[c] += (trace.channel_bits[step] >> c) & 1u;
        for (int c = 0; c < continuous_count; ++c) {
            float const value = trace.values[static_cast<std::size_t>(step) * continuous_count + c];
            ++histograms.continuous[c][entropy_bin(value)];
        }
    }
    return histograms;
}

}   // namespace

Tile tile_of(Arena const& arena, float x, float y) {
    float const side = std::max(arena.width, arena.height);
    assert(x >= 0 && x < side && y >= 0 && y < side);
    return {static_cast<std::uint8_t>(tiles_per_side * x / side), static_cast<std::uint8_t>(tiles_per_side * y / side)};
}

std::array<double, channel_count> entropies(ChannelHistograms const& histograms, int steps) {
    std::array<double, channel_count> result{};
    if (steps == 0) return result;
    for (int c = 0; c < continuous_count; ++c)
        result[continuous_channels[c]] = entropy(histograms.continuous[c], steps);
    for (int c = 0; c < binary_count; ++c) {
        std::uint32_t const ones = histograms.ones[c];
        result[binary_channels[c]] = entropy<2>({static_cast<std::uint32_t>(steps) - ones, ones}, steps);
    }
    return result;
}

Descriptors describe(Arena const& arena, Trace const& trace) {
    Descriptors d;
    auto const& released = trace.final_world.released;
    d.ball_positions.assign(released.begin(),
                            released.begin() + static_cast<std::ptrdiff_t>(arena.task.ball_positions.size()));
    d.channel_bits = trace.channel_bits;
    for (int step = 0; step < trace.steps(); step += steps_per_tile_sample)
        d.path.push_back(tile_of(arena, trace.poses[step].x, trace.poses[step].y));
    d.entropies = entropies(histograms_of(trace), trace.steps());
    return d;
}

}   // namespace lore
