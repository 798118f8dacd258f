#pragma once

#include <lore/evolution/individual.h>

#include <span>
#include <vector>

namespace lore {

/// From the individual to its founder, the individual first (the order of Algorithm 1).
std::vector<Birth const*> lineage_of(Birth const&);

/// Every ancestor of the members, the members included, each once, in order of birth.
std::vector<Birth const*> ancestors_of(std::span<Individual const> members);

}   // namespace lore
