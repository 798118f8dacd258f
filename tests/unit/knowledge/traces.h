#pragma once

#include <lore/collectball/channels.h>
#include <lore/collectball/collectball.h>
#include <lore/core/random.h>
#include <lore/knowledge/index.h>
#include <lore/knowledge/knowledge_base.h>

#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace lore::test {

/// Windows of the usual channels: nine binary and six continuous ones, the last three of them effectors.
inline KnowledgeConfig config_of(int window_length = 20, float match_threshold = 1.83f) {
    return {window_length, match_threshold, collectball_channels()};
}

/// The bits of these channels that are binary ones.
inline constexpr std::uint16_t window_bits_mask = (1u << binary_count) - 1;

/// A trace of hand-made steps: each has its binary channels and one number for all six continuous channels.
struct Step {
    std::uint16_t bits;
    float level;
};

inline Trace trace_of(std::initializer_list<Step> steps) {
    Trace trace;
    trace.channels = collectball_channels();
    for (Step const& step : steps) {
        trace.channel_bits.push_back(step.bits);
        trace.values.insert(trace.values.end(), continuous_count, step.level);
    }
    return trace;
}

/// One-step features and their values.
inline KnowledgeBase base_of(std::initializer_list<Step> features, std::vector<double> const& values,
                             std::uint32_t count = 1, Provenance provenance = {}) {
    Trace const trace = trace_of(features);
    std::vector<std::uint32_t> const counts(values.size(), count);
    return KnowledgeBase{
        config_of(1), std::move(provenance), {trace.channel_bits, trace.values, values, values, counts}};
}

/// Windows and what they are worth, each shown by one individual.
inline KnowledgeBase base_of(KnowledgeConfig const& config, std::vector<Window> const& windows,
                             std::vector<double> const& values) {
    FeatureWindows features;
    for (Window const& window : windows) features.add(config.channels, window);
    std::vector<std::uint32_t> const counts(values.size(), 1);
    return KnowledgeBase{config, {}, {features.bits, features.values, values, values, counts}};
}

/// A trace that looks like a robot's: lights come and go, wheels mostly at their stops, ranges drift. `phrases` short
/// sequences are repeated with small changes, so that windows resemble each other as those of a lineage do.
inline Trace lifelike_trace(Stream& rng, int steps) {
    Trace trace;
    trace.channels = collectball_channels();
    std::uint16_t bits = static_cast<std::uint16_t>(rng.bits() & window_bits_mask);
    float values[continuous_count]{0.2f, 0.4f, 0.1f, 1.0f, 0.9f, 0.5f};
    for (int step = 0; step < steps; ++step) {
        if (rng.chance(0.05)) bits ^= static_cast<std::uint16_t>(1u << rng.below(binary_count));
        if (rng.chance(0.02)) bits = 0;
        for (int channel = 0; channel < continuous_count; ++channel) {
            float& value = values[channel];
            if (channel < 3) value += static_cast<float>(rng.uniform(-0.05, 0.05));
            else if (rng.chance(0.04))
                value = rng.coin() ? (rng.coin() ? 0.0f : 1.0f) : static_cast<float>(rng.uniform());
            value = value < 0 ? 0 : value > 1 ? 1 : value;
            trace.values.push_back(value);
        }
        trace.channel_bits.push_back(bits);
    }
    return trace;
}

}   // namespace lore::test
