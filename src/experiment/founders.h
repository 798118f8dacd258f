#pragma once

#include <lore/evolution/evolution.h>
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
/// These files with checksum and kind. Throws UsageError: one is not there, or named twice.
std::vector<FileRecord> founders_records(std::vector<std::string> const& from);

/// The genomes that founders come from, founder i from genome i modulo their number. The genomes of a run are its last
/// population in the order in which selection left it (lineage.lore); of a knowledge base they are clones, drawn by
/// `seed` (knowledge/clone.h), as many as the population. Several origins share alike: they are dealt in turn, genome i
/// from origin i modulo their number, each its first ones, again from the first where it has too few, and as many of
/// each as make up the population.
/// Throws Error: missing or damaged; UsageError: made for other channels, beyond the limits, or more origins than
/// founders that come from them.
std::vector<Genome> read_founder_genomes(std::vector<std::string> const& from, Channels const&, EvolutionConfig const&,
                                         std::uint64_t seed);

}   // namespace lore
