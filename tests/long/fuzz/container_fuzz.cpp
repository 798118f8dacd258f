// The header of every binary file, as it comes and with its checksum made right.

#include "fuzz_input.h"

#include <xxhash.h>

#include <cstring>

using namespace lore;

namespace {

constexpr std::size_t checksum_at = 56;

void unseal_as_any_kind(Bytes const& file) {
    for (FileKind kind : {FileKind::lineage, FileKind::checkpoint, FileKind::knowledge_base, FileKind::all_individuals,
                          FileKind::genome})
        fuzz::accepts([&] { unseal(file, kind, "fuzz"); });
    fuzz::MemoryFile const stored{file};
    fuzz::accepts([&] { map_container(stored.path(), kind_of_file(stored.path())); });
}

}   // namespace

void read_input(std::span<std::byte const> input) {
    Bytes file(input.begin(), input.end());
    unseal_as_any_kind(file);
    if (file.size() < container_header_size) return;
    XXH3_state_t* const state = XXH3_createState();
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, file.data(), checksum_at);
    XXH3_64bits_update(state, file.data() + container_header_size, file.size() - container_header_size);
    std::uint64_t const sum = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    std::memcpy(file.data() + checksum_at, &sum, sizeof sum);
    unseal_as_any_kind(file);
}
