#include <lore/world/values.h>

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace lore {

namespace {

/// Whether all lie in [0, most]; NaN does not. Compiles to vectors: no branch, no early end.
bool all_within(std::span<float const> values, float most) {
    bool good = true;
    for (float const value : values) good &= (value >= 0) & (value <= most);
    return good;
}

bool all_binary(std::span<float const> values) {
    bool good = true;
    for (float const value : values) good &= (value == 0) | (value == 1);
    return good;
}

bool all_finite(std::span<float const> values) {
    bool good = true;
    for (float const value : values) good &= std::abs(value) <= std::numeric_limits<float>::max();
    return good;
}

std::string number(float value) { return std::isnan(value) ? "NaN, or was not written" : fmt::format("{}", value); }

std::string wrong_position(char const* axis, std::span<float const> values, char const* edge, float most) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!all_within(values.subspan(i, 1), most))
            return fmt::format("{} of life {} is {}, and positions lie in 0 .. {} = {}", axis, i, number(values[i]),
                               edge, most);
    return "";
}

std::string wrong_sensor(WorldFacts const& facts, std::size_t sensor, std::span<float const> values) {
    bool const binary = facts.sensors[sensor].binary;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (auto const one = values.subspan(i, 1); binary ? !all_binary(one) : !all_within(one, 1))
            return fmt::format("{}sensor '{}' of life {} is {}, and {}", binary ? "binary " : "",
                               facts.sensors[sensor].name, i, number(values[i]),
                               binary ? "only 0 and 1 are binary" : "sensors lie in [0, 1]");
    return "";
}

}   // namespace

std::string why_senses_are_wrong(WorldFacts const& facts, std::span<float const> sensors, std::span<float const> x,
                                 std::span<float const> y) {
    std::size_t const lives = x.size();
    for (std::size_t s = 0; s < facts.sensors.size(); ++s) {
        auto const values = sensors.subspan(s * lives, lives);
        bool const good = facts.sensors[s].binary ? all_binary(values) : all_within(values, 1);
        if (!good) return wrong_sensor(facts, s, values);
    }
    if (!all_within(x, facts.width)) return wrong_position("x", x, "width", facts.width);
    if (!all_within(y, facts.height)) return wrong_position("y", y, "height", facts.height);
    return "";
}

std::string why_results_are_wrong(std::span<float const> rewards, std::span<unsigned char const> over,
                                  std::span<unsigned char const> before) {
    bool good = all_finite(rewards);
    for (std::size_t i = 0; i < over.size(); ++i)
        good &= over[i] <= 1 && (before[i] == 0 || (over[i] == 1 && rewards[i] == 0));
    if (good) return "";
    for (std::size_t i = 0; i < over.size(); ++i) {
        if (!all_finite(rewards.subspan(i, 1)))
            return fmt::format("the reward of life {} is {}, and rewards are finite", i, number(rewards[i]));
        if (over[i] > 1) return fmt::format("over of life {} is {}, or was not written, and is 0 or 1", i, over[i]);
        if (before[i] != 0 && over[i] == 0) return fmt::format("life {} is not over, and was before", i);
        if (before[i] != 0 && rewards[i] != 0)
            return fmt::format("the reward of life {} is {}, and the life was over before", i, rewards[i]);
    }
    return "";
}

std::string why_outcomes_are_wrong(WorldFacts const& facts, std::span<float const> values, int lives) {
    if (all_finite(values)) return "";
    auto const count = static_cast<std::size_t>(lives);
    for (std::size_t k = 0; k < static_cast<std::size_t>(facts.outcome_size); ++k)
        for (std::size_t i = 0; i < count; ++i)
            if (float const value = values[k * count + i]; !std::isfinite(value))
                return fmt::format("outcome {} of life {} is {}, and outcomes are finite", k, i, number(value));
    return "";
}

}   // namespace lore
