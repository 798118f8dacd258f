#pragma once

#include "support/sample_archive.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/npy_file.h>
#include <lore/collectball/trace_file.h>
#include <lore/experiment/config.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <array>
#include <filesystem>
#include <string>

#include <zlib.h>

namespace lore::test {

inline constexpr char sample_array[] = "windows.npy";
inline constexpr char sample_trace[] = "trace.csv", sample_packed_trace[] = "trace.csv.gz";

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

    std::string rows = progress_header("balls") + "\n";
    for (int generation : {0, 1}) {
        GenerationSummary row;
        row.generation = generation;
        row.mean_reward = 1.25;
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
    manifest.world.reward_unit = "balls";
    manifest.best_reward = 2;
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
    EvolutionState end = write_sample_archive(directory, robots_world());
    write_sample_tables(directory);
    write_sample_documents(directory);
    return end;
}

}   // namespace lore::test
