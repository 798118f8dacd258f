#pragma once

#include <lore/archive/container.h>
#include <lore/network/genome.h>

#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Genomes that a run may start from, made by `lore-kb clone`. The file also names the channels that they serve, in
/// order and with those that are binary: controllers of another robot are refused.
struct FoundersFile {
    std::string kind;     ///< "clones of a knowledge base"
    std::string origin;   ///< how they were made: a JSON object (docs/manual/formats.md)
    std::vector<Genome> genomes;
};

/// Atomic; throws Error (full disk, no permission), the former file survives.
void write_founders(std::string const& path, FoundersFile const&);
/// Throws Error: missing or damaged; UsageError: made for other sensors or effectors.
FoundersFile read_founders(std::string const& path);
/// From a container's payload; `name` is what errors call it.
FoundersFile unpack_founders(std::span<std::byte const> payload, std::string_view name);

}   // namespace lore
