#pragma once

#include "boost_types.h"

#include <lore/evolution/lineage.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace lore {

/// Births in order of birth, each naming its parent by its place in the table: the part that lineage archives and
/// checkpoints share.
void put_births(OutArchive&, std::vector<Birth const*> const& births);
/// Checks order, parents, genomes and numbers.
std::vector<std::shared_ptr<Birth const>> get_births(InArchive&);

/// Place of an id in a table in order of birth, or the table's size.
template <class BirthPointer>
std::size_t place_of(std::vector<BirthPointer> const& births, IndividualId id) {
    auto const at = std::lower_bound(births.begin(), births.end(), id,
                                     [](auto const& birth, IndividualId wanted) { return birth->id < wanted; });
    return at != births.end() && (*at)->id == id ? static_cast<std::size_t>(at - births.begin()) : births.size();
}

}   // namespace lore
