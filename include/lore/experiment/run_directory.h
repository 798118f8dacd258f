#pragma once

#include <lore/archive/lineage_file.h>
#include <lore/experiment/config.h>

#include <string>

namespace lore {

/// A directory that lore-evolve wrote (interfaces: config.toml, arena.toml, manifest.json, progress.csv, lineage.lore,
/// all.lore, checkpoint.lore), read back by the other programs.
struct RunDirectory {
    std::string path;
    ExperimentConfig config;
    Arena arena;
    LineageArchive lineage;
    /// "best", or "GENERATION.SLOT". Throws UsageError.
    std::shared_ptr<Birth const> individual(std::string const& which) const;
};
RunDirectory open_run(std::string const& path);

} // namespace lore
