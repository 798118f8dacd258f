#pragma once

#include <lore/archive/all_individuals.h>
#include <lore/archive/container.h>
#include <lore/archive/world_record.h>
#include <lore/evolution/evolution.h>

#include <cstdint>
#include <string>

namespace lore {

/// A run at the end of a generation: what it takes to go on as if nothing had happened.
///
/// Streams have no state (core/random.h), so the population with its ancestors and the signature are all of evolution;
/// the rest are the run's books.
struct Checkpoint {
    EvolutionState state;
    WorldRecord world;   ///< the genomes have its interface
    std::uint64_t seed = 0;
    std::uint64_t config_digest = 0;   ///< of the settings that results depend on; must fit those resumed with
    std::uint64_t evaluations = 0, steps = 0;
    double seconds = 0;                   ///< wall time of all sessions
    std::uint64_t progress_bytes = 0;     ///< length of progress.csv
    AllIndividualsMark all_individuals;   ///< of all.lore; 0 bytes without
};

Bytes pack_checkpoint(Checkpoint const&);
/// `name` is what errors call it.
Checkpoint unpack_checkpoint(Payload const&, std::string_view name);

/// The former checkpoint stays as `older`; at every moment one of the two is whole, and they are never the same file.
/// If it cannot be written (full disk), both stay as they are.
void write_checkpoint(std::string const& path, std::string const& older, Checkpoint const&);

struct FoundCheckpoint {
    Checkpoint checkpoint;
    std::string warning;   ///< why the newer one was not taken, or ""
};
/// The newer of the two that is whole, which is then the one at `path`: a damaged newer one is replaced by the older,
/// so that the next checkpoint does not push the only whole one out. Throws the newer one's Error if neither is;
/// NewerFormat of the one at `path`, which is left where it is.
FoundCheckpoint read_checkpoint(std::string const& path, std::string const& older);

}   // namespace lore
