#pragma once

#include <lore/arena/arena.h>

#include <cstddef>
#include <cstdint>

namespace lore {

/// Most items that a vector among the fields of Descriptors may hold, by what it holds. Its reader also checks that
/// so many can follow.
template <class T>
inline constexpr std::size_t most_items = SIZE_MAX;
template <>
inline constexpr std::size_t most_items<Point> = most_balls;

}   // namespace lore
