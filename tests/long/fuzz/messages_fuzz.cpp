// What ranks say to each other; the first byte says which message the rest is.

#include "fuzz_input.h"

#include <lore/archive/messages.h>

using namespace lore;

void read_input(std::span<std::byte const> input) {
    if (input.empty()) return;
    auto const message = input.subspan(1);
    fuzz::accepts([&] {
        switch (std::to_integer<int>(input[0]) % 4) {
        case 0: {
            std::vector<Genome> const genomes = unpack_genomes(message);
            std::vector<Genome const*> pointers;
            for (Genome const& genome : genomes) pointers.push_back(&genome);
            unpack_genomes(pack_genomes(pointers));
            break;
        }
        case 1: unpack_deliveries(pack_deliveries(unpack_deliveries(message))); break;
        case 2: {
            ComparedPool pool;
            unpack_pool(message, pool);
            std::vector<Descriptors const*> members;
            for (Descriptors const& member : pool.members) members.push_back(&member);
            unpack_pool(pack_pool(pool.kind, pool.known, members), pool);   // where the same was
            break;
        }
        case 3: {
            std::vector<double> distances(25);
            unpack_distances(message, distances);
            break;
        }
        }
    });
}
