// The archive of all individuals: as it comes, and as one frame with the right checksum.

#include "fuzz_input.h"

#include <lore/archive/all_individuals.h>
#include <lore/archive/atomic_file.h>
#include <lore/collectball/collectball.h>

#include <xxhash.h>
#include <zstd.h>

#include <cstring>

using namespace lore;

namespace {

/// docs/manual/formats.md, "all.lore".
struct FrameHeader {
    std::uint32_t mark, generations;
    std::uint64_t raw_length, stored_length, checksum;
};

/// A file of collectball without frames.
Bytes head_of_robots() {
    fuzz::MemoryFile const stored{{}};
    {
        AllIndividualsWriter const head{stored.path(),
                                        world_record(CollectballWorld{load_arena("collectball", "source")}.facts())};
    }
    return read_file(stored.path());
}

void read(std::span<std::byte const> file) {
    fuzz::MemoryFile const stored{file};
    fuzz::accepts([&] { check_all_individuals(stored.path()); });
    fuzz::accepts([&] {
        for_each_individual(stored.path(), 1,
                            [](ArchivedIndividual const& one) { fuzz::demand(why_invalid(one.genome).empty()); });
    });
}

}   // namespace

void read_input(std::span<std::byte const> input) {
    read(input);
    if (input.empty()) return;
    auto const content = input.subspan(1);
    Bytes packed(ZSTD_compressBound(content.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), 1));
    FrameHeader header{0x4d415246, std::to_integer<std::uint32_t>(input[0]), content.size(), packed.size(), 0};
    header.checksum = XXH3_64bits_withSeed(packed.data(), packed.size(),
                                           XXH3_64bits_withSeed(&header, offsetof(FrameHeader, checksum), 0));
    static Bytes const head = head_of_robots();
    Bytes file = head;
    auto const* const first = reinterpret_cast<std::byte const*>(&header);
    file.insert(file.end(), first, first + sizeof header);
    file.insert(file.end(), packed.begin(), packed.end());
    read(file);
}
