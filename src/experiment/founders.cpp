#include "founders.h"

#include <lore/archive/founders_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/experiment/run_directory.h>
#include <lore/knowledge/clone.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr std::size_t most_origins = 200;   ///< their paths have room in lineage.lore

struct Origin {
    std::vector<Genome> genomes;
    Channels channels;   ///< that they serve
};

Origin last_population(std::string const& directory) {
    LineageArchive const lineage = read_lineage((std::filesystem::path{directory} / run_file::lineage).string());
    Origin origin{{}, lineage.world.channels};
    for (IndividualId const id : lineage.last_population) origin.genomes.push_back(lineage.find(id)->genome);
    if (origin.genomes.empty())
        throw UsageError(fmt::format("no founders in {}", directory), "its last population is empty",
                         "Take another run.");
    return origin;
}

Origin clones_of(std::string const& path, int count, std::uint64_t seed) {
    KnowledgeBase const base = read_knowledge_base(path);
    if (base.size() == 0)
        throw UsageError(fmt::format("no founders in {}", path), "the knowledge base has no features",
                         "Build another.");
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

void check_fit(std::string const& from, Origin const& origin, Channels const& channels, NetworkLimits const& limits) {
    if (std::string const why = why_misfit(origin.channels, channels); !why.empty())
        throw UsageError(fmt::format("{} does not fit the run", from), why,
                         "Take founders that were made for this world's channels.");
    for (std::size_t i = 0; i < origin.genomes.size(); ++i) {
        Genome const& genome = origin.genomes[i];
        auto const refuse = [&](std::string const& reason, std::string_view setting) {
            throw UsageError(fmt::format("{} does not fit the run", from),
                             fmt::format("its genome {} has {}", i, reason),
                             fmt::format("Set {} higher, or take other founders.", setting));
        };
        if (genome.hidden_count() > limits.max_hidden)
            refuse(fmt::format("{} hidden neurons, limits.max_hidden is {}", genome.hidden_count(), limits.max_hidden),
                   "limits.max_hidden");
        if (std::cmp_greater(genome.edges.size(), limits.max_edges))
            refuse(fmt::format("{} connections, limits.max_edges is {}", genome.edges.size(), limits.max_edges),
                   "limits.max_edges");
    }
}

}   // namespace

std::string absolute_path(std::string const& path) {
    return std::filesystem::absolute(path.empty() ? "." : path).lexically_normal().string();
}

std::string founders_path(std::string const& from) {
    return std::filesystem::is_directory(from) ? (std::filesystem::path{from} / run_file::lineage).string() : from;
}

std::vector<FileRecord> founders_records(std::vector<std::string> const& from) {
    if (from.size() > most_origins)
        throw UsageError(fmt::format("founders come from {} origins", from.size()),
                         fmt::format("a run takes them from {} at most", most_origins), "Name fewer.");
    std::vector<FileRecord> records;
    for (std::string const& one : from) {
        records.push_back(founders_record(one));
        if (std::count(from.begin(), from.end(), one) > 1)
            throw UsageError("founders cannot be taken", fmt::format("{} is named twice", one), "Name each once.");
    }
    return records;
}

std::vector<Genome> read_founder_genomes(std::vector<std::string> const& from, Channels const& channels,
                                         EvolutionConfig const& config, std::uint64_t seed) {
    int const origins = static_cast<int>(from.size()), inherited = inherited_founders(config);
    if (origins > 1 && origins > inherited)
        throw UsageError("founders cannot be taken", fmt::format("{} origins share {} founders", origins, inherited),
                         "Name fewer, or set founders.share or evolution.founders higher.");
    int const each = (config.population + origins - 1) / origins;
    std::vector<Origin> parts;
    for (std::string const& one : from) {
        parts.push_back(origin_of(one, each, seed));
        check_fit(one, parts.back(), channels, config.limits);
    }
    if (origins == 1) return std::move(parts[0].genomes);
    std::vector<Genome> genomes;
    for (std::size_t i = 0; std::cmp_less(i, each); ++i)
        for (Origin const& part : parts) genomes.push_back(part.genomes[i % part.genomes.size()]);
    return genomes;
}

}   // namespace lore
