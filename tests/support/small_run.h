#pragma once

#include <lore/archive/all_individuals.h>
#include <lore/archive/atomic_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <filesystem>
#include <string>

namespace lore::test {

/// Evolves a handful of individuals for a few short generations in this process, and leaves in `directory` what
/// lore-evolve would, but for checkpoints. `of`: of another world than the built-in arena.
inline void write_small_run(std::string const& directory, std::uint64_t seed = 1, WorldRequest const& of = {}) {
    std::filesystem::create_directories(directory);
    auto const file = [&](char const* name) { return (std::filesystem::path{directory} / name).string(); };
    ExperimentConfig config;
    config.world = of;
    config.episode.steps = 400;
    config.evolution.population = 8;
    config.evolution.founders = 16;
    config.evolution.generations = 6;
    config.evolution.distance_schedule.period = 2;
    write_file_atomically(file(run_file::config), to_toml(config));
    if (!config.has_world()) write_file_atomically(file(run_file::arena), std::string_view{arena_text_of(config)});
    RunWorld const world = open_run_world(config, arena_text_of(config));
    ProgressWriter progress{file(run_file::progress), 0, world.world->facts().reward_unit};
    config.evolution.interface = world.record().interface();
    SerialEvaluator evaluator{{world.world, config.episode, std::nullopt}};
    AllIndividualsWriter everybody{file(run_file::all_individuals), world.record()};
    EvolutionState const end = evolve(config.evolution, seed, evaluator, {}, [&](GenerationReport const& report) {
        everybody.add(report);
        progress.add(summarize(report));
        return true;
    });
    everybody.finish();
    write_lineage(file(run_file::lineage), end.population, world.record());
    Manifest manifest;
    manifest.status = RunStatus::done;
    manifest.generation = end.population.generation;
    manifest.world = world.record();
    manifest.outputs.push_back(record_of("output", file(run_file::lineage), run_file::lineage));
    write_manifest(file(run_file::manifest), manifest);
}

}   // namespace lore::test
