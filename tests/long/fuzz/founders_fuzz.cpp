// A founders file behind its checksum.

#include "fuzz_input.h"

#include <lore/archive/founders_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::accepts([&] {
        for (Genome const& genome : unpack_founders(fuzz::as_payload(input), "fuzz").genomes)
            fuzz::demand(why_invalid(genome).empty());
    });
}
