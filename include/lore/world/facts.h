#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Bounds of what a world may have. Widest channel layouts, files and messages rely on them (lore/world.h has the
/// same).
inline constexpr int most_sensors = 64;
inline constexpr int most_effectors = 16;
inline constexpr int most_outcomes = 256;
inline constexpr int most_lives = 1024;           ///< in a batch
inline constexpr int longest_name = 40;           ///< [bytes]
inline constexpr float largest_world = 1000000;   ///< [u]
inline constexpr int longest_scene = 1000000;     ///< [bytes]

/// A sensor or an effector. Its values lie in [0, 1]; those of a binary one are 0 or 1.
struct ChannelInfo {
    std::string name;   ///< an identifier: a lower-case letter, then lower-case letters, digits and '_'
    bool binary = false;
    friend bool operator==(ChannelInfo const&, ChannelInfo const&) = default;
};

/// What never changes in a world: all that evolution, files, reports and pictures know of it.
///
/// Worlds with equal sensors and effectors serve the same controllers.
struct WorldFacts {
    std::string name;                   ///< an identifier: "collectball"
    std::string task;                   ///< an identifier: "source"
    std::string reward_unit;            ///< what axes say: "balls"
    std::vector<ChannelInfo> sensors;   ///< in the order of neurons, windows and trace columns
    std::vector<ChannelInfo> effectors;
    int outcome_size = 0;          ///< numbers that the adhoc distance compares
    int max_batch = most_lives;    ///< most lives that begin_lives takes
    float width = 1, height = 1;   ///< positions lie in [0, width] x [0, height] [u]
    friend bool operator==(WorldFacts const&, WorldFacts const&) = default;
};

/// "world collectball source", as errors call it.
std::string title(WorldFacts const&);

/// Why the facts break a bound or a rule, with the channel and the numbers; "" if they keep them all: names are
/// identifiers, no two channels share one, counts lie within the bounds above, sizes are finite and above 0.
std::string why_invalid(WorldFacts const&);

}   // namespace lore
