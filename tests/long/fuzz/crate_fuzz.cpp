// ro-crate-metadata.json of a packed campaign that comes from somebody else.

#include "fuzz_input.h"

#include <interchange/crate_reading.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    read_crate({reinterpret_cast<char const*>(input.data()), input.size()});
}
