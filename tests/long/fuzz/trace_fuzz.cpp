// Traces: CSV, plain or compressed by gzip.

#include "fuzz_input.h"

#include <lore/collectball/trace_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    static Arena const arena = load_arena("collectball", "source");
    fuzz::MemoryFile const stored{input};
    fuzz::accepts([&] { follow(arena, read_trace_csv(stored.path(), arena)); });
    fuzz::accepts([&] { drive(arena, read_actions_csv(stored.path())); });
}
