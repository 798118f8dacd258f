#pragma once

#include "archive/random_population.h"

#include <lore/archive/all_individuals.h>
#include <lore/archive/checkpoint.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/lineage_file.h>

#include <filesystem>

namespace lore::test {

inline constexpr int sample_steps = 20;   ///< of an evaluation: files of a few kB
inline constexpr char sample_knowledge[] = "sample.lorekb";
inline constexpr char sample_founders[] = "founders.lore";

/// A tiny evolution, with every individual archived and a checkpoint in its middle.
inline EvolutionState write_sample_evolution(std::filesystem::path const& directory, WorldRecord const& world) {
    EvolutionConfig config = small_evolution(4, world.interface());
    config.population = 4;
    config.founders = 6;
    PretendedEvaluator evaluator{sample_steps};
    AllIndividualsWriter all{directory / "all.lore", world};
    EvolutionState const end = evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
        all.add(report);
        if (report.generation == 2) {
            Checkpoint checkpoint;
            checkpoint.state = *report.state;
            checkpoint.world = world;
            checkpoint.seed = 1;
            checkpoint.config_digest = 77;
            checkpoint.evaluations = 14;
            checkpoint.seconds = 1.5;
            checkpoint.progress_bytes = 123;
            checkpoint.all_individuals = all.mark();
            write_checkpoint(directory / "checkpoint.lore", directory / "no-older", checkpoint);
        }
        return true;
    });
    all.finish();
    write_lineage(directory / "lineage.lore", end.population, world);
    write_genome(directory / "failed-genome.lore",
                 {{3, 1}, end.population.members[0].birth->genome, 1, "out of memory", world});
    return end;
}

inline void write_sample_founders(std::filesystem::path const& directory, WorldRecord const& world) {
    FoundersFile founders{"clones of a knowledge base", R"({"base": "kb.lorekb", "seed": 1})", {}, world};
    for (std::uint32_t slot = 0; slot < 2; ++slot)
        founders.genomes.push_back(founder(world.interface(), Stream{slot, Purpose::founder}));
    write_founders(directory / sample_founders, founders);
}

/// Two features of three steps; of a world other than collectball with evidence and with negative rewards too.
inline void write_sample_knowledge(std::filesystem::path const& directory, WorldRecord const& world) {
    constexpr std::size_t window = 3, features = 2;
    bool const has_more = world.name != "collectball";
    KnowledgeArrays arrays;
    std::uint16_t next = 1;
    for (std::size_t step = 0; step < window * features; ++step)
        for (int word = 0; word < world.channels.words(); ++word)
            arrays.bits.push_back(static_cast<std::uint16_t>(next++ & binary_mask(world.channels, word)));
    arrays.windows.assign(window * features * static_cast<std::size_t>(world.channels.continuous_count()), 0.25f);
    arrays.values = {1.5, has_more ? -2.25 : 2};
    arrays.reward_sums = {3, has_more ? -2.25 : 2};
    arrays.counts = {2, 1};
    if (has_more) {
        arrays.evidence.gammas = {0.5, 0.995};
        arrays.evidence.showings = {3, 1};
        arrays.evidence.return_sums = {0.5, -1, 1.25, -2};
        arrays.evidence.has_credit = true;
        arrays.evidence.news = {1, 0};
        arrays.evidence.gain_sums = {-0.5, 0};
        arrays.evidence.success_reward = 0.75;
        arrays.evidence.successes = 1;
        arrays.evidence.failures = 2;
        arrays.evidence.successes_that_showed = {1, 0};
        arrays.evidence.failures_that_showed = {1, 1};
    }
    Provenance provenance;
    provenance.made_by = "lore-kb build runs/s1";
    provenance.kind = "lineage";
    provenance.index = "exact";
    provenance.sources = {"runs/s1"};
    provenance.task = world.name + " " + world.task;
    provenance.reward_unit = world.reward_unit;
    provenance.individuals = 3;
    provenance.windows = 57;
    provenance.best_reward = has_more ? 2.5 : 2;
    write_knowledge_base(
        directory / sample_knowledge,
        KnowledgeBase{{static_cast<int>(window), 1.83f, world.channels}, provenance, std::move(arrays)});
}

/// A small file of every kind that the archive writes.
inline EvolutionState write_sample_archive(std::filesystem::path const& directory, WorldRecord const& world) {
    std::filesystem::create_directories(directory);
    write_sample_founders(directory, world);
    write_sample_knowledge(directory, world);
    return write_sample_evolution(directory, world);
}

}   // namespace lore::test
