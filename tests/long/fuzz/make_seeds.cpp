// make_seeds DIRECTORY: the inputs that the fuzzers start from, as the program itself writes them, one directory a
// target.

#include "support/sample_files.h"

#include <lore/archive/messages.h>
#include <lore/campaign/choice.h>

#include <cstdio>

using namespace lore;
using namespace lore::test;
namespace fs = std::filesystem;

namespace {

class Seeds {
public:
    explicit Seeds(fs::path directory) : directory_(std::move(directory)) {}
    void write(char const* target, std::string const& name, std::span<std::byte const> content) const {
        fs::create_directories(directory_ / target);
        write_file_atomically(directory_ / target / name, content);
    }
    /// A payload whose first byte tells the target how to read the rest.
    void write(char const* target, std::string const& name, std::size_t first, std::span<std::byte const> rest) const {
        Bytes content{static_cast<std::byte>(first)};
        content.insert(content.end(), rest.begin(), rest.end());
        write(target, name, content);
    }

private:
    fs::path directory_;
};

struct Sealed {
    char const* target;
    FileKind kind;
    char const* file;
};

/// Its first byte says the format version (fuzz_input.h), but for knowledge bases, which have a layout of their own.
void write_payload(Seeds const& seeds, Sealed const& one, fs::path const& file, std::string const& name) {
    Payload const payload = read_container(file, one.kind);
    if (one.kind == FileKind::knowledge_base) seeds.write(one.target, name, payload.bytes);
    else seeds.write(one.target, name, payload.version - 1, payload.bytes);
}

void files(Seeds const& seeds, fs::path const& samples) {
    for (Sealed const& one : {Sealed{"lineage", FileKind::lineage, run_file::lineage},
                              Sealed{"checkpoint", FileKind::checkpoint, run_file::checkpoint},
                              Sealed{"genome", FileKind::genome, run_file::failed_genome},
                              Sealed{"founders", FileKind::founders, sample_founders},
                              Sealed{"knowledge", FileKind::knowledge_base, sample_knowledge}}) {
        write_payload(seeds, one, samples / one.file, one.file);
        seeds.write("container", one.target, read_file(samples / one.file));
        fs::path const data = LORE_SOURCE_DIR "/tests/data";
        write_payload(seeds, one, data / "version-1" / one.file, "version-1");
        write_payload(seeds, one, data / "version-2" / "toy" / one.file, "toy");
    }
    seeds.write("all_individuals", "file", read_file(samples / run_file::all_individuals));
    // What the checkpoint keeps is the content of a frame; the target seals it, its generations come first.
    Checkpoint const checkpoint =
        unpack_checkpoint(read_container(samples / run_file::checkpoint, FileKind::checkpoint), "sample");
    seeds.write("all_individuals", "frame", checkpoint.all_individuals.generations,
                checkpoint.all_individuals.gathered);

    struct Plain {
        char const* target;
        char const* file;
    };
    for (Plain const& one :
         {Plain{"npy", sample_array}, Plain{"trace", sample_trace}, Plain{"trace", sample_packed_trace},
          Plain{"progress", run_file::progress}, Plain{"manifest", run_file::manifest},
          Plain{"config", run_file::config}, Plain{"arena", run_file::arena}})
        seeds.write(one.target, one.file, read_file(samples / one.file));
    fs::path const jobs = LORE_SOURCE_DIR "/jobs";
    for (char const* name : {"source.toml", "target.toml"})
        seeds.write("config", name, read_file(jobs / "tasks" / name));
    for (char const* name : {"small.toml", "paper.toml"})
        seeds.write("campaign", name, read_file(jobs / "campaigns" / name));
}

/// The first byte as in results_fuzz.cpp.
void results(Seeds const& seeds, fs::path const& samples) {
    fs::path const sample = LORE_SOURCE_DIR "/tests/long/browser/sample";
    std::size_t which = 0;
    for (char const* name : {"runs.csv", "curves.csv", "kbs.csv", "replay.csv", "values.csv"})
        seeds.write("results", name, which++, read_file(sample / name));
    std::string const choice = samples / "choice.json";
    write_choice(choice, Choice{{{"kb1", 7, 3, 12345, 6}}, {{3, 12345, 6}, {4, 12346, 2}}, {5}});
    seeds.write("results", "choice.json", which++, read_file(choice));
    std::string_view const failure = R"({"attempts": 2, "how": "exit code 1", "log_tail": ["a line", "another"]})";
    seeds.write("results", "failure.json", which++, std::as_bytes(std::span{failure.data(), failure.size()}));
    seeds.write("results", "population.csv", which++, read_file(sample / "population.csv"));
    seeds.write("results", "scene.json", which++, read_file(sample / "scene.json"));
    auto const write_text = [&](char const* name, std::string_view text) {
        seeds.write("results", name, which++, std::as_bytes(std::span{text.data(), text.size()}));
    };
    write_text("speed.csv",
               "treatment,runs,generations,reached_1,time_1,time_1_low,time_1_high,median_1,reached_3,time_3,"
               "time_3_low,time_3_high,median_3,reached_5,time_5,time_5_low,time_5_high,median_5,area,area_low,"
               "area_high\nnone,2,9,1,5.5,2,9,5.5,0,9,9,9,9,0,9,9,9,9,3.5,0,7\n");
    write_text("leads.csv", "treatment,policy,none,generation,balls,policy_balls,none_balls,share\n"
                            "kb1,policy,none,9,1.5,2,1,0.5\n");
}

void messages(Seeds const& seeds, Population const& population) {
    std::vector<Genome const*> genomes;
    std::vector<Delivery> deliveries;
    std::vector<Descriptors const*> pool;
    for (Individual const& member : population.members) {
        genomes.push_back(&member.birth->genome);
        deliveries.push_back(
            {static_cast<int>(deliveries.size()), PretendedEvaluator::pretend(member.birth->genome, sample_steps)});
        pool.push_back(member.descriptors.get());
    }
    seeds.write("messages", "genomes", 0, pack_genomes(genomes));
    seeds.write("messages", "deliveries", 1, pack_deliveries(deliveries));
    for (int k = 0; k < distance_kinds; ++k) {
        auto const kind = static_cast<DistanceKind>(k);
        seeds.write("messages", "pool_" + std::string{name(kind)}, 2, pack_pool(kind, 1, pool));
    }
    seeds.write("messages", "distances", 3, pack_distances(std::vector<double>(25)));
}

void crates(Seeds const& seeds) {
    constexpr std::string_view crate =
        R"({"@graph": [{"@id": "ro-crate-metadata.json", "about": {"@id": "./"},
                        "conformsTo": {"@id": "https://w3id.org/ro/crate/1.2"}},
                       {"@id": "./", "@type": "Dataset", "name": "N", "description": "D", "datePublished": "2026-01-31",
                        "license": "L"},
                       {"@id": "a%20b.csv", "@type": ["File"], "contentSize": "7", "sha256": "00ff"},
                       {"@id": "#left-out/c", "@type": "File", "localPath": "c"}]})";
    seeds.write("crate", "small", std::as_bytes(std::span{crate.data(), crate.size()}));
}

}   // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: make_seeds DIRECTORY\n", stderr);
        return 2;
    }
    Seeds const seeds{argv[1]};
    fs::path const samples = fs::path{argv[1]} / "samples";
    EvolutionState const evolved = write_sample_files(samples);
    files(seeds, samples);
    results(seeds, samples);
    messages(seeds, evolved.population);
    crates(seeds);
}
