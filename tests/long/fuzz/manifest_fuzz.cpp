// manifest.json.

#include "fuzz_input.h"

#include <lore/experiment/manifest.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::MemoryFile const stored{input};
    fuzz::accepts([&] { read_manifest(stored.path()); });
}
