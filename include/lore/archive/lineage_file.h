#pragma once

#include <lore/evolution/individual.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// The lineages of a run, read back: every ancestor of the last population, in order of birth.
struct LineageArchive {
    std::vector<std::shared_ptr<Birth const>> births;   ///< in order of birth, parents linked
    std::vector<IndividualId> last_population;          ///< the members of the last population
    IndividualId best;                                  ///< best-of-run
    int generation = 0;                                 ///< of the last population
    /// Throws Error if no such individual is archived.
    std::shared_ptr<Birth const> find(IndividualId) const;
};

void write_lineage(std::string const& path, Population const&);
LineageArchive read_lineage(std::string const& path);
/// From a container's payload; `name` is what errors call it.
LineageArchive unpack_lineage(std::span<std::byte const> payload, std::string_view name);

}   // namespace lore
