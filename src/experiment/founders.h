#pragma once

#include <lore/experiment/manifest.h>
#include <lore/network/genome.h>

#include <string>
#include <vector>

namespace lore {

/// As founders.from and the world's place are kept: a run may be resumed from another directory. "": the present one.
std::string absolute_path(std::string const& path);
/// The file behind the setting founders.from: the lineage.lore of a run's directory, or the founders file or knowledge
/// base itself.
std::string founders_path(std::string const& from);
/// That file with checksum and kind. Throws UsageError: there is none.
FileRecord founders_record(std::string const& from);

/// The genomes that founders come from: the last population of a run in the order in which selection left it
/// (lineage.lore), a founders file's, or `count` clones of a knowledge base, drawn by `seed` (knowledge/clone.h).
/// Throws Error: missing or damaged; UsageError: made for other channels, or beyond the limits.
std::vector<Genome> read_founder_genomes(std::string const& from, Channels const&, NetworkLimits const&, int count,
                                         std::uint64_t seed);

}   // namespace lore
