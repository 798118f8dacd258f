#pragma once

#include <lore/episode/episode.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lore {

inline constexpr int longest_window = 4000;   ///< [steps]: an evaluation of the paper

/// How windows are cut and matched.
struct KnowledgeConfig {
    int window_length = 20;   ///< Steps per window, 1 to longest_window [steps]. Paper: T = 20.
    float match_threshold =
        1.83f;   ///< A window nearer than this to its nearest feature is that feature [L2, not squared; strict].

    /// What squared distances are compared with, rounded once to float; every index uses this number.
    float squared_threshold() const { return match_threshold * match_threshold; }

    Channels channels = {};   ///< of the windows
    friend bool operator==(KnowledgeConfig const&, KnowledgeConfig const&) = default;
};

/// window_length consecutive steps of one evaluation, the unit of knowledge (paper, "Behavioral features").
///
/// A view, valid as long as its Trace. Distance between two windows: Frobenius over the window_length x channels
/// values; the binary channels contribute the number of differing bits, the continuous ones the squares of their
/// differences.
struct Window {
    std::span<std::uint16_t const> bits;   ///< [step][word], as Trace::channel_bits; only bits of binary channels count
    std::span<float const> values;         ///< [step][continuous channel], as Trace::values
};

/// The bits of binary channels in word number `word` of a step; the others belong to the Hamming descriptor.
std::uint16_t binary_mask(Channels const&, int word);

/// Adds a window's bits, those of binary channels alone.
void append_binary_bits(Channels const&, Window const&, std::vector<std::uint16_t>& to);

/// All channels of one step, in their order.
std::vector<float> channels_at(Channels const&, Window const&, std::size_t step);

/// The non-overlapping windows of a trace in order; steps that do not fill a last window are left out.
std::vector<Window> windows_of(Trace const&, int window_length);

/// Squared distance, the plain definition. Precondition: windows of these channels, of equal length.
/// The sum's order is part of it: the squares go to 16 partial sums by their index modulo 16, which are then added
/// pairwise (8 + 8, 4 + 4, 2 + 2, 1 + 1), and the differing bits last.
float squared_distance(Channels const&, Window const&, Window const&);

}   // namespace lore
