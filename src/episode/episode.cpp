#include <lore/episode/episode.h>

#include "stillness.h"

namespace lore {

namespace {

/// The loop itself; `observe` is inlined, so that recording costs no call.
template <class Observe>
WorldState simulate(Arena const& arena, Network const& network, EpisodeConfig const& config, Observe&& observe) {
    RobotState robot = start_robot(arena);
    WorldState world = start_world(arena);
    NetworkState state;
    int still_steps = 0;
    for (int step = 0; step < config.steps; ++step) {
        Sensors const sensors = sense(arena, robot, world);
        Effectors effectors;
        tick(network, sensors, state, effectors);
        Pose const pose = robot.pose;
        act(arena, pose, effectors, world);
        move(arena, effectors, world, robot);
        observe(StepView{step, pose, sensors, effectors, world, robot});
        if (config.stop_when_still > 0 && is_still(pose, robot.pose) && ++still_steps > config.stop_when_still) break;
    }
    return world;
}

float channel_value(Sensors const& sensors, Effectors const& effectors, int channel) {
    return channel < sensor_count ? sensors[static_cast<std::size_t>(channel)]
                                  : effectors[static_cast<std::size_t>(channel - sensor_count)];
}

}   // namespace

std::uint16_t channel_bits(Sensors const& sensors, Effectors const& effectors) {
    auto const channel = [&](int c) { return channel_value(sensors, effectors, c); };
    unsigned bits = 0, bit = 0;
    for (int const c : binary_channels) bits |= static_cast<unsigned>(channel(c) > 0.5f) << bit++;
    for (int const c : continuous_channels) bits |= static_cast<unsigned>(channel(c) > 0.5f) << bit++;
    return static_cast<std::uint16_t>(bits);
}

WorldState run_episode(Arena const& arena, Network const& network, EpisodeConfig const& config,
                       std::function<void(StepView const&)> const& observe) {
    return simulate(arena, network, config, [&](StepView const& view) { observe(view); });
}

Trace record_episode(Arena const& arena, Network const& network, EpisodeConfig const& config) {
    Trace trace;
    auto const steps = static_cast<std::size_t>(config.steps);
    trace.channel_bits.reserve(steps);
    trace.poses.reserve(steps);
    trace.values.reserve(steps * continuous_count);
    trace.final_world = simulate(arena, network, config, [&](StepView const& view) {
        trace.channel_bits.push_back(channel_bits(view.sensors, view.effectors));
        trace.poses.push_back(view.pose);
        if (view.world.collected > static_cast<int>(trace.deliveries.size())) trace.deliveries.push_back(view.step);
        for (int const c : continuous_channels) trace.values.push_back(channel_value(view.sensors, view.effectors, c));
    });
    return trace;
}

}   // namespace lore
