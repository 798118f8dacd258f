#pragma once

#include <lore/archive/container.h>
#include <lore/archive/world_record.h>
#include <lore/evolution/individual.h>

#include <string>
#include <string_view>

namespace lore {

/// An individual whose evaluation failed, kept so that lore-replay repeats exactly that evaluation.
struct FailedIndividual {
    IndividualId id;
    Genome genome;
    int rank = 0;   ///< on which it failed
    std::string reason;
    WorldRecord world;   ///< in which it failed; the genome has its interface
};

void write_genome(std::string const& path, FailedIndividual const&);
FailedIndividual read_genome(std::string const& path);
/// From a container's payload; `name` is what errors call it.
FailedIndividual unpack_genome(Payload const&, std::string_view name);

}   // namespace lore
