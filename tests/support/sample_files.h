#pragma once

#include "archive/random_population.h"

#include <lore/archive/all_individuals.h>
#include <lore/archive/atomic_file.h>
#include <lore/archive/checkpoint.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/archive/npy_file.h>
#include <lore/archive/trace_file.h>
#include <lore/experiment/config.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <array>
#include <filesystem>
#include <string>

#include <zlib.h>

namespace lore::test {

inline constexpr int sample_steps = 20;   ///< of an evaluation: files of a few kB
inline constexpr char sample_knowledge[] = "sample.lorekb";
inline constexpr char sample_founders[] = "founders.lore";
inline constexpr char sample_array[] = "windows.npy";
inline constexpr char sample_trace[] = "trace.csv", sample_packed_trace[] = "trace.csv.gz";

/// A tiny evolution, with every individual archived and a checkpoint in its middle.
inline EvolutionState write_sample_evolution(std::filesystem::path const& directory) {
    EvolutionConfig config = small_evolution(4);
    config.population = 4;
    config.founders = 6;
    PretendedEvaluator evaluator{sample_steps};
    AllIndividualsWriter all{directory / run_file::all_individuals};
    EvolutionState const end = evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
        all.add(report);
        if (report.generation == 2) {
            Checkpoint checkpoint;
            checkpoint.state = *report.state;
            checkpoint.seed = 1;
            checkpoint.config_digest = 77;
            checkpoint.evaluations = 14;
            checkpoint.seconds = 1.5;
            checkpoint.progress_bytes = 123;
            checkpoint.all_individuals = all.mark();
            write_checkpoint(directory / run_file::checkpoint, directory / "no-older", checkpoint);
        }
        return true;
    });
    all.finish();
    write_lineage(directory / run_file::lineage, end.population);
    write_genome(directory / run_file::failed_genome,
                 {{3, 1}, end.population.members[0].birth->genome, 1, "out of memory"});
    return end;
}

inline void write_sample_founders(std::filesystem::path const& directory) {
    FoundersFile founders{"clones of a knowledge base", R"({"base": "kb.lorekb", "seed": 1})", {}};
    for (std::uint32_t slot = 0; slot < 2; ++slot) founders.genomes.push_back(founder(Stream{slot, Purpose::founder}));
    write_founders(directory / sample_founders, founders);
}

inline void write_sample_knowledge(std::filesystem::path const& directory) {
    constexpr std::size_t window = 3, features = 2;
    KnowledgeArrays arrays;
    arrays.bits = {1, 2, 3, 4, 5, 511};
    arrays.windows.assign(window * features * continuous_count, 0.25f);
    arrays.values = {1.5, 2};
    arrays.reward_sums = {3, 2};
    arrays.counts = {2, 1};
    Provenance provenance;
    provenance.made_by = "lore-kb build runs/s1";
    provenance.kind = "lineage";
    provenance.index = "exact";
    provenance.sources = {"runs/s1"};
    provenance.task = "collectball source";
    provenance.individuals = 3;
    provenance.windows = 57;
    provenance.best_balls = 2;
    write_knowledge_base(directory / sample_knowledge,
                         KnowledgeBase{{static_cast<int>(window), 1.83f}, provenance, std::move(arrays)});
}

inline void write_sample_tables(std::filesystem::path const& directory) {
    std::vector<float> values(60);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) / 64;
    write_npy(directory / sample_array, values, std::array<std::size_t, 2>{2, 30});

    std::vector<Effectors> const actions(5, Effectors{0.7f, 0.6f, 0.9f});
    std::string const trace = trace_csv(drive(load_arena("collectball", "source"), actions));
    write_file_atomically(directory / sample_trace, std::string_view{trace});
    gzFile const packed = gzopen((directory / sample_packed_trace).c_str(), "wb");
    gzwrite(packed, trace.data(), static_cast<unsigned>(trace.size()));
    gzclose(packed);

    std::string rows = progress_header() + "\n";
    for (int generation : {0, 1}) {
        GenerationSummary row;
        row.generation = generation;
        row.mean_balls = 1.25;
        row.seconds = 3.5;
        rows += text(row) + "\n";
    }
    write_file_atomically(directory / run_file::progress, std::string_view{rows});
}

inline void write_sample_documents(std::filesystem::path const& directory) {
    write_file_atomically(directory / run_file::config, std::string_view{to_toml({})});
    write_file_atomically(directory / run_file::arena, std::string_view{arena_text("collectball")});
    Manifest manifest;
    manifest.status = RunStatus::interrupted;
    manifest.name = "source";
    manifest.task = "source";
    manifest.seed = 0xffffffffffffffffu;
    manifest.generation = 12;
    manifest.generations = 40;
    manifest.signature = "0123456789abcdef";
    manifest.best_balls = 2;
    manifest.best = "3.4";
    manifest.build.version = "1.0.0";
    manifest.build.libraries = {{"zstd", "1.5.4"}};
    manifest.inputs = {{"configuration", "jobs/source.toml", 10, "0123456789abcdef"}};
    manifest.outputs = {{"output", "lineage.lore", 12, "0123456789abcdef"}};
    manifest.sessions.push_back({"lore-evolve",
                                 "2025-01-01T00:00:00Z",
                                 "2025-01-01T00:00:09Z",
                                 0,
                                 12,
                                 2,
                                 {"here", "there"},
                                 "v4",
                                 1.25,
                                 "signal 10"});
    write_manifest(directory / run_file::manifest, manifest);
}

/// A small file of every kind that Lore writes, under the names that it has in the directory of a run.
inline EvolutionState write_sample_files(std::string const& directory) {
    std::filesystem::create_directories(directory);
    write_sample_founders(directory);
    write_sample_knowledge(directory);
    write_sample_tables(directory);
    write_sample_documents(directory);
    return write_sample_evolution(directory);
}

}   // namespace lore::test
