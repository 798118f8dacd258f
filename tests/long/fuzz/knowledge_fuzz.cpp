// A knowledge base behind its checksum.

#include "fuzz_input.h"

#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    Bytes const file = seal(FileKind::knowledge_base, input, Packing::plain);
    fuzz::MemoryFile const stored{file};
    fuzz::accepts([&] { knowledge_csv(read_knowledge_base(stored.path())); });
}
