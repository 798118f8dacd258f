// Configurations of a run. What is accepted must survive being written and read again.

#include "fuzz_input.h"

#include <lore/experiment/config.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::accepts([&] {
        ExperimentConfig const config = parse_config(fuzz::as_text(input), "fuzz", "/nowhere");
        ExperimentConfig const again = parse_config(to_toml(config), "again", "/nowhere");
        fuzz::demand(differing_settings(config, again).empty());
    });
}
