#pragma once

#include <lore/evolution/individual.h>

#include <span>
#include <vector>

namespace lore {

/// From the individual to its founder, the individual first (the order of the paper's Algorithm 1). The pointers are
/// valid as long as the individual.
std::vector<Birth const*> lineage_of(Birth const&);

/// Every ancestor of the members, the members included, each once, in order of birth. The pointers are valid as long as
/// the members.
std::vector<Birth const*> ancestors_of(std::span<Individual const> members);

}   // namespace lore
