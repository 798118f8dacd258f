// A checkpoint behind its checksum, and what evolution does with it first: measure all distances anew.

#include "fuzz_input.h"

#include <lore/archive/checkpoint.h>
#include <lore/behavior/distance_matrix.h>

using namespace lore;

namespace {

constexpr std::size_t longest_path = 2000;   ///< edit distances of longer ones only take time

}   // namespace

void read_input(std::span<std::byte const> input) {
    fuzz::accepts([&] {
        Checkpoint const checkpoint = unpack_checkpoint(fuzz::as_payload(input), "fuzz");
        std::vector<Descriptors const*> pool;
        for (Individual const& member : checkpoint.state.population.members) {
            if (member.descriptors->path.size() > longest_path) return;
            pool.push_back(member.descriptors.get());
        }
        int const size = static_cast<int>(pool.size());
        DistanceMatrix matrix{size};
        for (int kind = 0; kind < distance_kinds; ++kind)
            measure_rows(static_cast<DistanceKind>(kind), pool, 0, size, matrix);
        fuzz::demand(unpack_checkpoint({pack_checkpoint(checkpoint)}, "fuzz").state.population.members.size() ==
                     pool.size());
    });
}
