#pragma once

#include <lore/evolution/individual.h>

#include <string>

namespace lore {

/// An individual whose evaluation failed, kept so that lore-replay repeats exactly that evaluation.
struct FailedIndividual {
    IndividualId id;
    Genome genome;
    int rank = 0;   ///< on which it failed
    std::string reason;
};

void write_genome(std::string const& path, FailedIndividual const&);
FailedIndividual read_genome(std::string const& path);

}   // namespace lore
