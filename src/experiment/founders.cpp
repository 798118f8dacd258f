#include "founders.h"

#include <lore/archive/founders_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/experiment/run_directory.h>
#include <lore/knowledge/clone.h>

#include <filesystem>

#include <fmt/format.h>

namespace lore {

namespace {

struct Origin {
    std::vector<Genome> genomes;
    Channels channels;   ///< that they serve
};

Origin last_population(std::string const& directory) {
    LineageArchive const lineage = read_lineage((std::filesystem::path{directory} / run_file::lineage).string());
    Origin origin{{}, lineage.world.channels};
    for (IndividualId const id : lineage.last_population) origin.genomes.push_back(lineage.find(id)->genome);
    return origin;
}

Origin clones_of(std::string const& path, int count, std::uint64_t seed) {
    KnowledgeBase const base = read_knowledge_base(path);
    return {clone(base, {.count = count, .seed = seed}).genomes, base.config().channels};
}

constexpr char clones[] = "clones of a knowledge base";

bool is_knowledge_base(std::string const& path) {
    return !std::filesystem::is_directory(path) && kind_of_file(path) == FileKind::knowledge_base;
}

Origin origin_of(std::string const& from, int count, std::uint64_t seed) {
    if (std::filesystem::is_directory(from)) return last_population(from);
    if (is_knowledge_base(from)) return clones_of(from, count, seed);
    FoundersFile file = read_founders(from);
    return {std::move(file.genomes), file.world.channels};
}

}   // namespace

std::string absolute_path(std::string const& path) {
    return std::filesystem::absolute(path.empty() ? "." : path).lexically_normal().string();
}

std::string founders_path(std::string const& from) {
    return std::filesystem::is_directory(from) ? (std::filesystem::path{from} / run_file::lineage).string() : from;
}

FileRecord founders_record(std::string const& from) {
    bool const is_run = std::filesystem::is_directory(from);
    std::string const path = founders_path(from);
    if (!std::filesystem::exists(path))
        throw UsageError(
            fmt::format("no founders in {}", from),
            is_run ? fmt::format("there is no {}, which is written when a run stops or ends", run_file::lineage)
                   : std::string{"no such file"},
            "Give the directory of a finished run, a knowledge base, or a file that 'lore-kb clone' wrote.");
    FileRecord record = record_of(file_role::founders, path, path);
    record.kind = is_run ? "last population of a run" : is_knowledge_base(path) ? clones : read_founders(path).kind;
    return record;
}

std::vector<Genome> read_founder_genomes(std::string const& from, Channels const& channels, NetworkLimits const& limits,
                                         int count, std::uint64_t seed) {
    auto [genomes, theirs] = origin_of(from, count, seed);
    if (std::string const why = why_misfit(theirs, channels); !why.empty())
        throw UsageError(fmt::format("{} does not fit the run", from), why,
                         "Take founders that were made for this world's channels.");
    for (std::size_t i = 0; i < genomes.size(); ++i) {
        auto const refuse = [&](std::string const& reason, std::string_view setting) {
            throw UsageError(fmt::format("{} does not fit the run", from),
                             fmt::format("its genome {} has {}", i, reason),
                             fmt::format("Set {} higher, or take other founders.", setting));
        };
        if (genomes[i].hidden_count() > limits.max_hidden)
            refuse(
                fmt::format("{} hidden neurons, limits.max_hidden is {}", genomes[i].hidden_count(), limits.max_hidden),
                "limits.max_hidden");
        if (std::cmp_greater(genomes[i].edges.size(), limits.max_edges))
            refuse(fmt::format("{} connections, limits.max_edges is {}", genomes[i].edges.size(), limits.max_edges),
                   "limits.max_edges");
    }
    return genomes;
}

}   // namespace lore
