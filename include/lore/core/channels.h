#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lore {

/// The sensorimotor interface that every arena offers and every controller serves (paper, "Robot, environment and
/// goal-oriented fitness"): 12 sensors, then 3 effectors, all values in [0, 1].
///
/// The order is the order of the columns in trace.csv, of a window's channels and of the network's inputs and outputs.
inline constexpr int sensor_count = 12;
inline constexpr int effector_count = 3;
inline constexpr int channel_count = sensor_count + effector_count;

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
    left_wheel,
    right_wheel,
    collect
};

/// Channels with values between 0 and 1 (three range sensors, three effectors), in channel order.
inline constexpr std::array<int, 6> continuous_channels{0, 1, 2, 12, 13, 14};
/// Channels that are 0 or 1 (lights, bumpers, carrying), in channel order.
inline constexpr std::array<int, 9> binary_channels{3, 4, 5, 6, 7, 8, 9, 10, 11};

inline constexpr int continuous_count = static_cast<int>(continuous_channels.size());
inline constexpr int binary_count = static_cast<int>(binary_channels.size());

inline constexpr std::array<std::string_view, channel_count> channel_names{
    "range_right",  "range_left",  "range_ahead",  "ball_right",  "ball_left",
    "basket_right", "basket_left", "switch_right", "switch_left", "bumper_right",
    "bumper_left",  "carrying",    "left_wheel",   "right_wheel", "collect"};

}   // namespace lore
