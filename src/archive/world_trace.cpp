#include <lore/archive/world_trace.h>

#include <fmt/format.h>

namespace lore {

std::string trace_csv(World const& world, Network const& network, EpisodeConfig const& config) {
    Channels const channels{world.facts()};
    std::string text = "step,x,y";
    auto const out = std::back_inserter(text);
    for (int i = 0; i < channels.sensors(); ++i) fmt::format_to(out, ",in{}", i);
    for (int i = 0; i < channels.effectors(); ++i) fmt::format_to(out, ",a{}", i);
    text += ",reward\n";

    std::vector<float> values(static_cast<std::size_t>(channels.count()));
    auto const sensors = std::span{values}.first(static_cast<std::size_t>(channels.sensors()));
    auto const effectors = std::span{values}.subspan(sensors.size());
    auto const life = world.begin();
    NetworkState state;
    bool over = false;
    for (int step = 0; step < config.steps && !over; ++step) {
        Position const position = life->sense(sensors);
        tick(network, sensors, state, effectors);
        round_binary_effectors(channels, effectors);
        StepResult const result = life->act(effectors);
        fmt::format_to(out, "{},{},{}", step, position.x, position.y);
        for (float const value : values) fmt::format_to(out, ",{}", value);
        fmt::format_to(out, ",{}\n", result.reward);
        over = result.over;
    }
    return text;
}

}   // namespace lore
