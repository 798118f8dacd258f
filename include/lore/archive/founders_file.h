#pragma once

#include <lore/archive/container.h>
#include <lore/archive/world_record.h>
#include <lore/network/genome.h>

#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Genomes that a run may start from, made by `lore-kb clone`.
struct FoundersFile {
    std::string kind;     ///< "clones of a knowledge base"
    std::string origin;   ///< how they were made: a JSON object (docs/manual/formats.md)
    std::vector<Genome> genomes;
    WorldRecord world;   ///< whose channels they serve; the genomes have its interface
};

/// Atomic; throws Error (full disk, no permission), the former file survives.
void write_founders(std::string const& path, FoundersFile const&);
/// Of any world. Throws Error: missing or damaged.
FoundersFile read_founders(std::string const& path);
/// From a container's payload; `name` is what errors call it.
FoundersFile unpack_founders(Payload const&, std::string_view name);

}   // namespace lore
