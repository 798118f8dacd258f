#include <lore/experiment/verification.h>

#include <lore/archive/all_individuals.h>
#include <lore/archive/atomic_file.h>
#include <lore/archive/checkpoint.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/npy_file.h>
#include <lore/collectball/arena.h>
#include <lore/core/csv.h>
#include <lore/core/error.h>
#include <lore/core/input_file.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

std::string verify_container(std::string const& path) {
    FileKind const kind = kind_of_file(path);
    switch (kind) {
    case FileKind::lineage: {
        LineageArchive const lineage = read_lineage(path);
        return fmt::format("lineage archive of {} individuals, generation {}{}", lineage.births.size(),
                           lineage.generation,
                           lineage.founders ? fmt::format(", founders from {} ({} {})", lineage.founders->kind,
                                                          lineage.founders->path, lineage.founders->checksum)
                                            : "");
    }
    case FileKind::checkpoint: {
        Checkpoint const checkpoint = unpack_checkpoint(read_container(path, kind), path);
        return fmt::format("checkpoint of generation {}", checkpoint.state.population.generation);
    }
    case FileKind::knowledge_base:
        return fmt::format("knowledge base of {} features", read_knowledge_base(path).size());
    case FileKind::all_individuals: {
        AllIndividualsSummary const all = check_all_individuals(path);
        return fmt::format("archive of all {} individuals, {} generations", all.individuals, all.generations);
    }
    case FileKind::founders: {
        FoundersFile const founders = read_founders(path);
        return fmt::format("founders file of {} genomes: {}", founders.genomes.size(), founders.kind);
    }
    case FileKind::genome: return fmt::format("genome of individual {}", text(read_genome(path).id));
    }
    throw Error(fmt::format("cannot verify {}", path), "its kind is unknown", "Update Lore.");
}

using Lacks = std::function<bool(std::string const& path)>;

std::string verify_manifest(std::string const& path, Lacks const& lacks) {
    Manifest const manifest = read_manifest(path);
    std::filesystem::path const directory = std::filesystem::path{path}.parent_path();
    for (FileRecord const& output : manifest.outputs) {
        // An archive of strangers may list anything, and nothing outside of it is looked at.
        if (output.path.empty() || output.path == ".." || output.path.find('/') != std::string::npos)
            throw Error(fmt::format("cannot read {}", path),
                        fmt::format("it lists an output outside of its directory, '{}'", output.path),
                        "Take a copy that is whole.");
        if (lacks((directory / output.path).string())) continue;
        if (!std::filesystem::exists(directory / output.path))
            throw Error(fmt::format("{} is missing", (directory / output.path).string()),
                        fmt::format("{} lists it", path), "Resume the run, or take a copy that is whole.");
        FileRecord const found = record_of(output.role, (directory / output.path).string(), output.path);
        if (found.bytes != output.bytes || found.checksum != output.checksum)
            throw Error(fmt::format("{} is not as {} lists it", (directory / output.path).string(), path),
                        fmt::format("{} bytes with checksum {}, not {} with {}", found.bytes, found.checksum,
                                    output.bytes, output.checksum),
                        "It was changed since; take a copy that is whole.");
    }
    return fmt::format("manifest of a run ({}), {} outputs as listed", name(manifest.status), manifest.outputs.size());
}

/// An arena file has several tasks; the configuration beside it says which of them the run is on.
std::string verify_arena(std::string const& path) {
    std::filesystem::path const config = std::filesystem::path{path}.replace_filename(run_file::config);
    if (!std::filesystem::exists(config))
        throw Error(fmt::format("cannot verify {}", path), fmt::format("there is no {} beside it", run_file::config),
                    "Verify it in the directory of its run.");
    std::string const task = read_config(config.string()).task;
    load_arena(path, task);
    return fmt::format("arena with a task '{}'", task);
}

std::string verify_json(std::string const& path) {
    std::vector<std::byte> const bytes = read_file(path);
    auto const* const text = reinterpret_cast<char const*>(bytes.data());
    if (!nlohmann::json::accept(text, text + bytes.size()))
        throw Error(fmt::format("cannot read {}", path), "it is no JSON document", "Take a copy that is whole.");
    return "JSON document";
}

/// Rows as long as the header, the last one ended: a table that was cut is told by it, but not one that was edited.
std::string verify_table(std::string const& path) {
    constexpr std::string_view remedy = "Take a copy that is whole.";
    std::string const text = read_text(path, most_data);
    if (!text.ends_with('\n')) throw Error(fmt::format("cannot read {}", path), "its last line was cut", remedy);
    return fmt::format("table of {} rows", count_csv_rows(path, text, remedy));
}

[[noreturn]] void refuse_without(std::string const& run, std::string_view file) {
    throw Error(fmt::format("the run in {} is not whole", run), fmt::format("there is no {}", file),
                "Take a copy that is whole.");
}

/// The checkpoint belongs to the run, and its table reaches as far: else --resume would refuse it.
void verify_that_it_goes_on(std::string const& run) {
    std::filesystem::path const directory{run};
    std::string const path = (directory / run_file::checkpoint).string(),
                      progress = (directory / run_file::progress).string();
    Checkpoint const checkpoint = unpack_checkpoint(read_container(path, FileKind::checkpoint), path);
    if (std::uint64_t const seed = read_manifest((directory / run_file::manifest).string()).seed;
        checkpoint.seed != seed)
        throw Error(fmt::format("{} is of another run", path),
                    fmt::format("its seed is {}, that of {} is {}", checkpoint.seed, run_file::manifest, seed),
                    "Take a copy that is whole.");
    std::uint64_t const bytes = std::filesystem::exists(progress) ? open_regular(progress).size : 0;
    if (bytes < checkpoint.progress_bytes)
        throw Error(
            fmt::format("{} was cut", progress),
            fmt::format("it has {} bytes, of the {} that the checkpoint knows", bytes, checkpoint.progress_bytes),
            "Take a copy that is whole.");
}

std::string verify_directory(std::string const& path, Lacks const& lacks) {
    constexpr std::array always{run_file::config, run_file::manifest};
    constexpr std::array known{run_file::config,           run_file::arena,           run_file::progress,
                               run_file::lineage,          run_file::all_individuals, run_file::checkpoint,
                               run_file::older_checkpoint, run_file::failed_genome,   run_file::manifest};
    auto const is_there = [&](char const* file) { return std::filesystem::exists(std::filesystem::path{path} / file); };
    if (std::none_of(known.begin(), known.end(), is_there))
        throw Error(fmt::format("cannot verify {}", path), "no run is in this directory", "Check the path.");
    for (char const* const file : always)
        if (!is_there(file)) refuse_without(path, file);
    if (!read_config((std::filesystem::path{path} / run_file::config).string()).has_world() &&
        !is_there(run_file::arena))
        refuse_without(path, run_file::arena);
    std::vector<std::string> whole;
    for (char const* const file : known) {
        if (!is_there(file)) continue;
        verify((std::filesystem::path{path} / file).string(), lacks);
        whole.emplace_back(file);
    }
    if (is_there(run_file::checkpoint)) verify_that_it_goes_on(path);
    return fmt::format("run directory with {}", fmt::join(whole, ", "));
}

}   // namespace

std::string verify(std::string const& path) {
    return verify(path, [](std::string const&) { return false; });
}

std::string verify(std::string const& path, Lacks const& lacks) {
    std::filesystem::path const file{path};
    if (std::filesystem::is_directory(file)) return verify_directory(path, lacks);
    if (file.extension() == ".npy")
        return fmt::format("NPY array of shape ({})", fmt::join(read_npy(path).shape, ", "));
    if (file.filename() == run_file::manifest) return verify_manifest(path, lacks);
    if (file.filename() == run_file::config) {
        read_config(path);
        return "configuration of a run";
    }
    if (file.filename() == run_file::arena) return verify_arena(path);
    if (file.filename() == run_file::progress)
        return fmt::format("progress of {} generations", read_progress(path).size());
    if (file.extension() == ".csv") return verify_table(path);
    if (file.extension() == ".json") return verify_json(path);
    return verify_container(path);
}

}   // namespace lore
