#pragma once

#include <lore/world/channels.h>

#include <cstddef>
#include <cstdint>

namespace lore {

/// Most items that a vector among the fields of Descriptors may hold, by what it holds. Its reader also checks that
/// so many can follow.
template <class T>
inline constexpr std::size_t most_items = SIZE_MAX;
template <>
inline constexpr std::size_t most_items<float> = most_outcomes;
template <>
inline constexpr std::size_t most_items<double> = most_channels;   ///< entropies

}   // namespace lore
