#pragma once

#include <lore/archive/container.h>
#include <lore/archive/world_record.h>
#include <lore/evolution/individual.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Where the founders of a run came from that were not random. Of several origins, paths and checksums are lists with
/// ", " between.
struct FoundersOrigin {
    std::string kind;       ///< "last population of a run", "clones of a knowledge base", "several kinds"
    std::string path;       ///< of the file: lineage.lore of that run, knowledge base, or founders file
    std::string checksum;   ///< XXH3-64 of that file, 16 hexadecimal digits
    friend bool operator==(FoundersOrigin const&, FoundersOrigin const&) = default;
};

/// The lineages of a run, read back: every ancestor of the last population, in order of birth.
struct LineageArchive {
    WorldRecord world;
    std::vector<std::shared_ptr<Birth const>> births;   ///< in order of birth, parents linked
    std::vector<IndividualId> last_population;          ///< the members of the last population
    IndividualId best;                                  ///< best-of-run
    int generation = 0;                                 ///< of the last population
    std::optional<FoundersOrigin> founders;             ///< none: all founders were random
    /// Throws Error if no such individual is archived.
    std::shared_ptr<Birth const> find(IndividualId) const;
};

/// Without an origin of the founders, the bytes are those of a run that knows of none.
/// Precondition: the genomes have the world's interface.
void write_lineage(std::string const& path, Population const&, WorldRecord const&,
                   std::optional<FoundersOrigin> const& = std::nullopt);
LineageArchive read_lineage(std::string const& path);
/// From a container's payload; `name` is what errors call it.
LineageArchive unpack_lineage(Payload const&, std::string_view name);

}   // namespace lore
