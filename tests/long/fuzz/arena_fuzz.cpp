// Arenas. In what is accepted a robot can drive.

#include "fuzz_input.h"

#include <lore/collectball/replay.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::accepts([&] {
        Arena const arena = parse_arena(fuzz::as_text(input), "fuzz", "source");
        std::vector<Effectors> const actions(40, Effectors{1.0f, 0.9f, 0.9f});
        drive(arena, actions);
    });
}
