#pragma once

#include <lore/archive/lineage_file.h>
#include <lore/experiment/run_world.h>

#include <string>

namespace lore {

/// Names of what lore-evolve writes into the directory of a run (docs/manual/formats.md).
namespace run_file {
inline constexpr char config[] = "config.toml";
inline constexpr char arena[] = "arena.toml";
inline constexpr char manifest[] = "manifest.json";
inline constexpr char progress[] = "progress.csv";
inline constexpr char lineage[] = "lineage.lore";
inline constexpr char all_individuals[] = "all.lore";
inline constexpr char checkpoint[] = "checkpoint.lore";
inline constexpr char older_checkpoint[] = "checkpoint-older.lore";
inline constexpr char failed_genome[] = "failed-genome.lore";
inline constexpr char lock[] = "lock";
}   // namespace run_file

/// A directory that lore-evolve wrote, read back by the other programs.
struct RunDirectory {
    std::string path;
    ExperimentConfig config;
    RunWorld world;
    LineageArchive lineage;
    std::string file(std::string_view name) const;
    /// "best", or "GENERATION.SLOT". Throws UsageError.
    std::shared_ptr<Birth const> individual(std::string const& which) const;
};
/// Throws Error: no such directory, no run in it, not finished yet (no lineage), or a damaged file.
RunDirectory open_run(std::string const& path);
/// Likewise of a run that is not finished: its lineage is empty.
RunDirectory open_unfinished_run(std::string const& path);

/// "12.7": generation and slot, as users type and read it.
std::string text(IndividualId);
/// Throws UsageError.
IndividualId individual_id(std::string_view text);

}   // namespace lore
