#pragma once

#include <lore/world/world.h>

#include <string>

namespace lore {

/// Whether memory grows with each batch that is begun, stepped and ended: what it grows by, or "". Not measured in a
/// build with AddressSanitizer, which keeps what is freed.
struct MemoryGrowth {
    std::string what;       ///< "by 4096 bytes a batch of 16 lives"; "" if it does not
    std::string measured;   ///< "800 batches of 16 lives and 20 steps"
};
MemoryGrowth memory_growth(World const&, int lives);

}   // namespace lore
