#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lore {

/// The sensorimotor interface that every arena offers and every controller serves (paper, "Robot, environment and
/// goal-oriented fitness"): sensors, then effectors, all values in [0, 1].
///
/// The order is the order of the columns in trace.csv, of a window's channels and of the network's inputs and outputs.
/// A new channel is a line here and one in the table below (docs/manual/extending.md).
enum class Channel : std::uint8_t {
    range_right,
    range_left,
    range_ahead,   ///< at +45, -45 and 0 degrees (y grows downwards: +45 is to the right)
    ball_right,
    ball_left,
    basket_right,
    basket_left,
    switch_right,
    switch_left,
    bumper_right,
    bumper_left,
    carrying,
    left_wheel,   ///< the first effector
    right_wheel,
    collect
};
inline constexpr Channel first_effector = Channel::left_wheel;

/// A continuous channel has any value between 0 and 1 (ranges, effectors), a binary one 0 or 1 (lights, bumpers,
/// carrying).
enum class ChannelKind : std::uint8_t { continuous, binary };

struct ChannelEntry {
    Channel channel;
    std::string_view name;
    ChannelKind kind;
};

/// All channels, in their order.
inline constexpr auto channel_table = std::to_array<ChannelEntry>({
    {Channel::range_right, "range_right", ChannelKind::continuous},
    {Channel::range_left, "range_left", ChannelKind::continuous},
    {Channel::range_ahead, "range_ahead", ChannelKind::continuous},
    {Channel::ball_right, "ball_right", ChannelKind::binary},
    {Channel::ball_left, "ball_left", ChannelKind::binary},
    {Channel::basket_right, "basket_right", ChannelKind::binary},
    {Channel::basket_left, "basket_left", ChannelKind::binary},
    {Channel::switch_right, "switch_right", ChannelKind::binary},
    {Channel::switch_left, "switch_left", ChannelKind::binary},
    {Channel::bumper_right, "bumper_right", ChannelKind::binary},
    {Channel::bumper_left, "bumper_left", ChannelKind::binary},
    {Channel::carrying, "carrying", ChannelKind::binary},
    {Channel::left_wheel, "left_wheel", ChannelKind::continuous},
    {Channel::right_wheel, "right_wheel", ChannelKind::continuous},
    {Channel::collect, "collect", ChannelKind::continuous},
});

inline constexpr int channel_count = static_cast<int>(channel_table.size());
inline constexpr int sensor_count = static_cast<int>(first_effector);
inline constexpr int effector_count = channel_count - sensor_count;

namespace channel_facts {

consteval int count(ChannelKind kind) {
    int found = 0;
    for (ChannelEntry const& entry : channel_table) found += entry.kind == kind;
    return found;
}
template <ChannelKind kind>
consteval std::array<int, count(kind)> numbers() {
    std::array<int, count(kind)> result{};
    int next = 0;
    for (ChannelEntry const& entry : channel_table)
        if (entry.kind == kind) result[next++] = static_cast<int>(entry.channel);
    return result;
}
consteval std::array<std::string_view, channel_count> names() {
    std::array<std::string_view, channel_count> result;
    for (int c = 0; c < channel_count; ++c) result[c] = channel_table[c].name;
    return result;
}
consteval bool are_in_order() {
    for (int c = 0; c < channel_count; ++c)
        if (static_cast<int>(channel_table[c].channel) != c) return false;
    return true;
}
consteval bool effectors_are_continuous() {
    for (int c = sensor_count; c < channel_count; ++c)
        if (channel_table[c].kind != ChannelKind::continuous) return false;
    return true;
}

}   // namespace channel_facts

/// The channels of each kind, in channel order.
inline constexpr auto continuous_channels = channel_facts::numbers<ChannelKind::continuous>();
inline constexpr auto binary_channels = channel_facts::numbers<ChannelKind::binary>();
inline constexpr auto channel_names = channel_facts::names();

inline constexpr int continuous_count = static_cast<int>(continuous_channels.size());
inline constexpr int binary_count = static_cast<int>(binary_channels.size());
/// The first so many of continuous_channels; the effectors are the others.
inline constexpr int continuous_sensor_count = continuous_count - effector_count;

/// An effector's place among the effectors.
consteval int effector_place(Channel channel) { return static_cast<int>(channel) - sensor_count; }

static_assert(channel_facts::are_in_order(), "channel_table lists every Channel once, in the order of the enumeration");
static_assert(channel_facts::effectors_are_continuous(), "an effector is the output of a sigmoid, hence continuous");
static_assert(channel_count <= 16,
              "a step's word (Trace::channel_bits) has 16 bits, one a channel: 16 channels at most");

}   // namespace lore
