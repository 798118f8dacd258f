// Plans of a campaign. The configurations that they name do not exist, or are the fuzzed file itself.

#include "fuzz_input.h"

#include <lore/campaign/plan.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::MemoryFile const stored{input};
    fuzz::accepts([&] { read_campaign(stored.path()); });
}
