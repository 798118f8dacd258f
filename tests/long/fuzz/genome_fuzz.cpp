// A single genome behind its checksum.

#include "fuzz_input.h"

#include <lore/archive/genome_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    Bytes const file = seal(FileKind::genome, input, Packing::plain);
    fuzz::MemoryFile const stored{file};
    fuzz::accepts([&] { fuzz::demand(why_invalid(read_genome(stored.path()).genome).empty()); });
}
