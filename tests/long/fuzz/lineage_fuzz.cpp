// A lineage archive behind its checksum.

#include "fuzz_input.h"

#include <lore/archive/lineage_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::accepts([&] {
        LineageArchive const lineage = unpack_lineage(fuzz::as_payload(input), "fuzz");
        for (Birth const* birth = lineage.find(lineage.best).get(); birth != nullptr; birth = birth->parent.get())
            fuzz::demand(why_invalid(birth->genome).empty());
    });
}
