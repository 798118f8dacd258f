// A single genome behind its checksum.

#include "fuzz_input.h"

#include <lore/archive/genome_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::accepts([&] { fuzz::demand(why_invalid(unpack_genome(fuzz::as_payload(input), "fuzz").genome).empty()); });
}
