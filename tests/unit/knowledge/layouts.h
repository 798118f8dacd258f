#pragma once

#include <lore/core/random.h>
#include <lore/episode/episode.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace lore::test {

/// How many channels there are of each kind.
struct Layout {
    int binary, continuous;
};

/// Channels of such a layout in random order, the last sixteen at most being effectors.
inline Channels channels_of(Layout const& layout, Stream& rng) {
    std::vector<ChannelInfo> all(static_cast<std::size_t>(layout.binary + layout.continuous));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {"", std::cmp_less(i, layout.binary)};
    rng.shuffle(std::span{all});
    for (std::size_t i = 0; i < all.size(); ++i) all[i].name = "channel_" + std::to_string(i);
    auto const effectors = static_cast<std::ptrdiff_t>(std::min<std::size_t>(16, all.size() / 4));
    return Channels{{all.begin(), all.end() - effectors}, {all.end() - effectors, all.end()}};
}

/// Steps in which all is 0.
inline Trace blank_trace(Channels const& channels, int steps) {
    Trace trace;
    trace.channels = channels;
    trace.channel_bits.assign(static_cast<std::size_t>(steps * channels.words()), 0);
    trace.values.assign(static_cast<std::size_t>(steps * channels.continuous_count()), 0.0f);
    return trace;
}

/// Writes the channels of a step, as record_episode does: the continuous ones too have bits.
inline void put_step(Trace& trace, std::size_t step, std::span<float const> values) {
    auto const words = static_cast<std::size_t>(trace.channels.words());
    put_channel_bits(trace.channels, values, std::span{trace.channel_bits}.subspan(step * words, words));
    float* to = trace.values.data() + step * trace.channels.continuous().size();
    for (int const channel : trace.channels.continuous()) *to++ = values[static_cast<std::size_t>(channel)];
}

/// Continuous channels drift, or rest at an end of their range; binary ones change seldom.
inline Trace wandering_trace(Channels const& channels, Stream& rng, int steps) {
    Trace trace = blank_trace(channels, steps);
    std::vector<float> values(static_cast<std::size_t>(channels.count()));
    for (std::size_t c = 0; c < values.size(); ++c)
        values[c] = channels.is_binary(static_cast<int>(c)) ? 0.0f : static_cast<float>(rng.uniform());
    for (int step = 0; step < steps; ++step) {
        for (std::size_t c = 0; c < values.size(); ++c) {
            if (!channels.is_binary(static_cast<int>(c)))
                values[c] = std::clamp(values[c] + static_cast<float>(rng.uniform(-0.05, 0.05)), 0.0f, 1.0f);
            else if (rng.chance(0.03)) values[c] = 1 - values[c];
        }
        put_step(trace, static_cast<std::size_t>(step), values);
    }
    return trace;
}

/// The same life with some bits flipped and some values moved.
inline Trace changed(Trace trace, Stream& rng, double share) {
    auto const words = static_cast<std::size_t>(trace.channels.words());
    auto const binary = static_cast<std::uint32_t>(trace.channels.binary_count());
    for (std::size_t first = 0; binary > 0 && first < trace.channel_bits.size(); first += words)
        if (rng.chance(share)) {
            std::uint32_t const bit = rng.below(binary);
            trace.channel_bits[first + bit / 16] ^= static_cast<std::uint16_t>(1u << bit % 16);
        }
    for (float& value : trace.values)
        if (rng.chance(share)) value = std::clamp(value + static_cast<float>(rng.uniform(-0.5, 0.5)), 0.0f, 1.0f);
    return trace;
}

}   // namespace lore::test
