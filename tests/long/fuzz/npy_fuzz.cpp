// Arrays of NumPy.

#include "fuzz_input.h"

#include <lore/archive/knowledge_export.h>
#include <lore/archive/npy_file.h>
#include <lore/collectball/collectball.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    fuzz::MemoryFile const stored{input};
    fuzz::accepts([&] {
        NpyArray const array = read_npy(stored.path());
        std::size_t count = 1;
        for (std::size_t const size : array.shape) count *= size;
        fuzz::demand(count == array.values.size());
    });
    fuzz::accepts([&] {
        KnowledgeConfig const config{2, 1.83f, collectball_channels()};
        Trace const windows = read_windows(stored.path(), config);
        fuzz::demand(windows.values.size() ==
                     windows.channel_bits.size() * static_cast<std::size_t>(config.channels.continuous_count()));
    });
}
