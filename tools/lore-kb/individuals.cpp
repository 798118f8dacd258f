#include "command.h"

#include <lore/archive/all_individuals.h>
#include <lore/archive/container.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/genome_file.h>
#include <lore/core/error.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace lore::kb {

namespace {

using Json = nlohmann::ordered_json;

constexpr int individuals_format = 1;

struct IndividualsOptions {
    std::string path;
};

/// How the field of the reward is called; files that say no unit are older than others.
std::string_view word_of(WorldRecord const& world) {
    return reward_word(world.reward_unit.empty() ? first_reward_unit : std::string_view{world.reward_unit});
}

/// The first line. Names and paths in it may hold any bytes; those that are no UTF-8 are replaced.
void print_header(FileKind kind, std::uint64_t individuals, WorldRecord const& world, Json const& further) {
    Json header{{"format", individuals_format},
                {"kind", name(kind)},
                {"individuals", individuals},
                {"inputs", world.channels.sensors()},
                {"outputs", world.channels.effectors()}};
    if (word_of(world) != first_reward_unit) header["reward_unit"] = world.reward_unit;
    header.update(further);
    fmt::print("{}\n", header.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// "edges":[[source,target,gene],...],"biases":[gene,...], numbers in the shortest form that reads back to the same.
std::string genome_text(Genome const& genome) {
    std::string text = "\"edges\":[";
    char const* comma = "";
    for (Edge const& edge : genome.edges) {
        fmt::format_to(std::back_inserter(text), "{}[{},{},{}]", comma, edge.source, edge.target, edge.weight);
        comma = ",";
    }
    text += "],\"biases\":[";
    comma = "";
    for (float const bias : genome.biases) {
        fmt::format_to(std::back_inserter(text), "{}{}", comma, bias);
        comma = ",";
    }
    return text + ']';
}

std::string parent_text(std::optional<IndividualId> parent) {
    return parent ? fmt::format("\"{}\"", text(*parent)) : "null";
}

void print_lineage(std::string const& path) {
    LineageArchive const lineage = read_lineage(path);
    Json last = Json::array();
    for (IndividualId const id : lineage.last_population) last.push_back(text(id));
    Json further{
        {"generation", lineage.generation}, {"best", text(lineage.best)}, {"last_population", std::move(last)}};
    if (lineage.founders)
        further["founders"] = {{"kind", lineage.founders->kind},
                               {"path", lineage.founders->path},
                               {"xxh3_64", lineage.founders->checksum}};
    print_header(FileKind::lineage, lineage.births.size(), lineage.world, further);
    for (auto const& birth : lineage.births) {
        std::optional<IndividualId> parent;
        if (birth->parent != nullptr) parent = birth->parent->id;
        fmt::print("{{\"id\":\"{}\",\"parent\":{},\"{}\":{},\"shaping\":{},\"diversity\":{},{}}}\n", text(birth->id),
                   parent_text(parent), word_of(lineage.world), birth->reward, birth->shaping, birth->diversity,
                   genome_text(birth->genome));
    }
}

/// All frames are checked before the first line is printed.
void print_everybody(std::string const& path) {
    AllIndividualsSummary const all = check_all_individuals(path);
    print_header(FileKind::all_individuals, all.individuals, all.world, {{"generation", all.generations - 1}});
    for_each_individual(path, all.generations - 1, [&](ArchivedIndividual const& one) {
        fmt::print("{{\"id\":\"{}\",\"parent\":{},\"{}\":{},{}}}\n", text(one.id), parent_text(one.parent),
                   word_of(all.world), one.reward, genome_text(one.genome));
    });
}

void print_founders(std::string const& path) {
    FoundersFile const founders = read_founders(path);
    print_header(FileKind::founders, founders.genomes.size(), founders.world,
                 {{"founders", founders.kind}, {"origin", Json::parse(founders.origin)}});
    for (Genome const& genome : founders.genomes) fmt::print("{{{}}}\n", genome_text(genome));
}

void print_failed(std::string const& path) {
    FailedIndividual const failed = read_genome(path);
    print_header(FileKind::genome, 1, failed.world, {{"rank", failed.rank}, {"reason", failed.reason}});
    fmt::print("{{\"id\":\"{}\",{}}}\n", text(failed.id), genome_text(failed.genome));
}

void individuals(Program const&, IndividualsOptions const& options) {
    bool const is_run = std::filesystem::is_directory(options.path);
    std::string const path = is_run ? (std::filesystem::path{options.path} / run_file::lineage).string() : options.path;
    switch (FileKind const kind = kind_of_file(path); kind) {
    case FileKind::lineage: return print_lineage(path);
    case FileKind::all_individuals: return print_everybody(path);
    case FileKind::founders: return print_founders(path);
    case FileKind::genome: return print_failed(path);
    default:
        throw Error(fmt::format("no individuals to show in {}", path), fmt::format("it is a {}", name(kind)),
                    "Give a run, its lineage.lore or all.lore, or a founders file.");
    }
}

}   // namespace

void add_individuals(CLI::App& app, Program& program) {
    auto const options = std::make_shared<IndividualsOptions>();
    CLI::App* const command =
        add_command(app, program, "individuals", "Print archived individuals with their genomes, as JSON Lines",
                    options, individuals);
    command
        ->add_option("FILE", options->path,
                     "lineage.lore (or the directory of its run), all.lore, a founders file or failed-genome.lore")
        ->required();
}

}   // namespace lore::kb
