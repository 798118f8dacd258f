#pragma once

#include <cstddef>

namespace lore {

/// The most bytes that operator new was asked for at once since the last call (of this test program).
std::size_t take_largest_allocation();

}   // namespace lore
