// progress.csv.

#include "fuzz_input.h"

#include <lore/experiment/progress_file.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::MemoryFile const stored{input};
    fuzz::accepts([&] {
        for (GenerationSummary const& row : read_progress(stored.path())) text(row);
    });
}
