#include <lore/experiment/verification.h>

#include <lore/archive/all_individuals.h>
#include <lore/archive/checkpoint.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/npy_file.h>
#include <lore/core/error.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run_directory.h>

#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

std::string verify_container(std::string const& path) {
    FileKind const kind = kind_of_file(path);
    switch (kind) {
    case FileKind::lineage: {
        LineageArchive const lineage = read_lineage(path);
        return fmt::format("lineage archive of {} individuals, generation {}", lineage.births.size(), lineage.generation);
    }
    case FileKind::checkpoint: {
        Checkpoint const checkpoint = unpack_checkpoint(read_container(path, kind), path);
        return fmt::format("checkpoint of generation {}", checkpoint.state.population.generation);
    }
    case FileKind::knowledge_base: return fmt::format("knowledge base of {} features", read_knowledge_base(path).size());
    case FileKind::all_individuals: {
        AllIndividualsSummary const all = check_all_individuals(path);
        return fmt::format("archive of all {} individuals, {} generations", all.individuals, all.generations);
    }
    case FileKind::genome: return fmt::format("genome of individual {}", text(read_genome(path).id));
    }
    throw Error(fmt::format("cannot verify {}", path), "its kind is unknown", "Update Lore.");
}

std::string verify_manifest(std::string const& path) {
    Manifest const manifest = read_manifest(path);
    std::filesystem::path const directory = std::filesystem::path{path}.parent_path();
    for (FileRecord const& output : manifest.outputs) {
        FileRecord const found = record_of(output.role, (directory / output.path).string(), output.path);
        if (found.bytes != output.bytes || found.checksum != output.checksum)
            throw Error(fmt::format("{} is not as {} lists it", (directory / output.path).string(), path),
                        fmt::format("{} bytes with checksum {}, not {} with {}", found.bytes, found.checksum, output.bytes, output.checksum),
                        "It was changed since; take a copy that is whole.");
    }
    return fmt::format("manifest of a run ({}), {} outputs as listed", name(manifest.status), manifest.outputs.size());
}

std::string verify_directory(std::string const& path) {
    constexpr std::array known{run_file::config, run_file::lineage, run_file::all_individuals, run_file::checkpoint,
                               run_file::older_checkpoint, run_file::failed_genome, run_file::manifest};
    std::vector<std::string> whole;
    for (char const* const file : known) {
        std::filesystem::path const there = std::filesystem::path{path} / file;
        if (!std::filesystem::exists(there)) continue;
        verify(there.string());
        whole.emplace_back(file);
    }
    if (whole.empty()) throw Error(fmt::format("cannot verify {}", path), "no run is in this directory", "Check the path.");
    return fmt::format("run directory with {}", fmt::join(whole, ", "));
}

} // namespace

std::string verify(std::string const& path) {
    std::filesystem::path const file{path};
    if (std::filesystem::is_directory(file)) return verify_directory(path);
    if (file.extension() == ".npy") return fmt::format("NPY array of shape ({})", fmt::join(read_npy(path).shape, ", "));
    if (file.filename() == run_file::manifest) return verify_manifest(path);
    if (file.filename() == run_file::config) {
        read_config(path);
        return "configuration of a run";
    }
    return verify_container(path);
}

} // namespace lore
