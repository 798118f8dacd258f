#include "smooth_base.h"

#include <lore/core/random.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace lore {

namespace {

constexpr int channel_number = 8, window_steps = 20, features = 24'000, questions = 4'000, life_steps = 4'000;

Channels continuous_channels_only() {
    std::vector<ChannelInfo> sensors, effectors;
    for (int i = 0; i < channel_number; ++i)
        (i < 6 ? sensors : effectors).push_back({"channel_" + std::to_string(i), false});
    return {sensors, effectors};
}

/// Lives of 4000 steps, one after the other. Periods of 150 to 1500 steps: a window sees a piece of a wave.
Trace smooth_trace(Channels const& channels, Stream& rng, int windows) {
    constexpr int waves = 3;
    Trace trace;
    trace.channels = channels;
    int const steps = windows * window_steps;
    trace.channel_bits.assign(static_cast<std::size_t>(steps), 0);
    trace.values.resize(static_cast<std::size_t>(steps * channel_number));
    double speed[channel_number][waves]{}, phase[channel_number][waves]{};
    for (int step = 0; step < steps; ++step)
        for (int channel = 0; channel < channel_number; ++channel) {
            double sum = 0;
            for (int wave = 0; wave < waves; ++wave) {
                if (step % life_steps == 0) {
                    speed[channel][wave] = 2 * std::acos(-1.0) / rng.uniform(150, 1500);
                    phase[channel][wave] = rng.uniform(0, 6.3);
                }
                sum += std::sin(speed[channel][wave] * (step % life_steps) + phase[channel][wave]);
            }
            trace.values[static_cast<std::size_t>(step * channel_number + channel)] =
                static_cast<float>(std::clamp(0.5 + sum / (2 * waves - 2), 0.0, 1.0));
        }
    return trace;
}

}   // namespace

SmoothBase const& smooth_base() {
    static SmoothBase const base = [] {
        SmoothBase made;
        made.config = {window_steps, 100.0f, continuous_channels_only()};
        Stream rng{71, Purpose::test};
        made.features = smooth_trace(made.config.channels, rng, features);
        made.questions = smooth_trace(made.config.channels, rng, questions);
        made.known = windows_of(made.features, window_steps);
        made.asked = windows_of(made.questions, window_steps);
        auto const index = make_exact_index(made.config);
        for (Window const& window : made.known) index->add(window);
        auto const search = index->search();
        std::vector<float> nearest;
        for (Window const& window : made.asked) nearest.push_back(search->match(window).squared_distance);
        std::nth_element(nearest.begin(), nearest.begin() + questions / 2, nearest.end());
        made.config.match_threshold = std::sqrt(nearest[questions / 2]);
        return made;
    }();
    return base;
}

}   // namespace lore
