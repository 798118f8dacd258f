// Files of format version 1, kept in tests/data: every later version reads them, and finds in them what was written.
//
// LORE_RENEW_STORED_FILES=1 writes them anew, into the source tree; only right as long as version 1 is not released.

#include "support/sample_files.h"
#include "support/scratch.h"

#include <lore/core/checksum.h>
#include <lore/archive/knowledge_export.h>
#include <lore/core/error.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

using namespace lore;
using namespace lore::test;

namespace {

std::filesystem::path const stored{LORE_SOURCE_DIR "/tests/data/version-1"};

// ---- what is in a file, as text ----

std::string told(Genome const& genome) {
    std::string genes;
    for (Edge const& edge : genome.edges) genes += fmt::format("{} {} {:a}\n", edge.source, edge.target, edge.weight);
    for (float const bias : genome.biases) genes += fmt::format("{:a}\n", bias);
    return fmt::format("{} edges {} biases {}", genome.edges.size(), genome.biases.size(),
                       checksum_text(checksum(genes)));
}

std::string told(Birth const& birth) {
    return fmt::format("{} from {}: {} balls, shaping {}, diversity {}, {}\n", text(birth.id),
                       birth.parent ? text(birth.parent->id) : "nobody", birth.balls, birth.shaping, birth.diversity,
                       told(birth.genome));
}

std::string lineage_told(std::string const& path) {
    LineageArchive const lineage = read_lineage(path);
    std::string story = fmt::format("generation {}, best {}, last", lineage.generation, text(lineage.best));
    for (IndividualId const id : lineage.last_population) story += fmt::format(" {}", text(id));
    story += "\n";
    for (auto const& birth : lineage.births) story += told(*birth);
    return story;
}

std::string told(Individual const& member) {
    Descriptors const& descriptors = *member.descriptors;
    std::string values;
    for (Point const& ball : descriptors.ball_positions) values += fmt::format("{:a} {:a} ", ball.x, ball.y);
    values += fmt::format("{} ", fmt::join(descriptors.channel_bits, " "));
    for (Tile const tile : descriptors.path) values += fmt::format("{}/{} ", tile.x, tile.y);
    for (double const entropy : descriptors.entropies) values += fmt::format("{:a} ", entropy);
    return fmt::format("{} objectives {} {} {}, diversity {}, crowding {}, {} balls {} bits {} tiles {}\n",
                       member.objectives.count, member.objectives.value[0], member.objectives.value[1],
                       member.objectives.value[2], member.diversity, member.crowding, descriptors.ball_positions.size(),
                       descriptors.channel_bits.size(), descriptors.path.size(), checksum_text(checksum(values))) +
           told(*member.birth);
}

std::string checkpoint_told(std::string const& path) {
    Checkpoint const checkpoint = unpack_checkpoint(read_container(path, FileKind::checkpoint), path);
    AllIndividualsMark const& mark = checkpoint.all_individuals;
    std::string story = fmt::format("seed {} digest {} evaluations {} steps {} seconds {} progress {} signature "
                                    "{}\nall: {} bytes, chain {}, {} generations, gathered {}\n",
                                    checkpoint.seed, checkpoint.config_digest, checkpoint.evaluations, checkpoint.steps,
                                    checkpoint.seconds, checkpoint.progress_bytes, checkpoint.state.signature.text(),
                                    mark.bytes, mark.chain, mark.generations, checksum_text(checksum(mark.gathered)));
    Population const& population = checkpoint.state.population;
    story += fmt::format("generation {} by {}\n", population.generation, name(population.distance_kind));
    for (Individual const& member : population.members) story += told(member);
    return story;
}

std::string all_told(std::string const& path) {
    AllIndividualsSummary const summary = check_all_individuals(path);
    std::string story = fmt::format("{} generations, {} individuals\n", summary.generations, summary.individuals);
    for_each_individual(path, summary.generations - 1, [&](ArchivedIndividual const& one) {
        story += fmt::format("{} from {}: {} balls, {}\n", text(one.id), one.parent ? text(*one.parent) : "nobody",
                             one.balls, told(one.genome));
    });
    return story;
}

std::string knowledge_told(std::string const& path) {
    KnowledgeBase const base = read_knowledge_base(path);
    std::string story = fmt::format("windows of {}, threshold {}\n{}\n", base.config().window_length,
                                    base.config().match_threshold, provenance_json(base.provenance()));
    KnowledgeBase::Parts const& parts = base.parts();
    return story + fmt::format("{}\n{}\n{}\n{}\n{}\n", fmt::join(parts.bits, " "), fmt::join(parts.windows, " "),
                               fmt::join(parts.values, " "), fmt::join(parts.reward_sums, " "),
                               fmt::join(parts.counts, " "));
}

std::string genome_told(std::string const& path) {
    FailedIndividual const failed = read_genome(path);
    return fmt::format("{} on rank {}: {}, {}\n", text(failed.id), failed.rank, failed.reason, told(failed.genome));
}

std::string founders_told(std::string const& path) {
    FoundersFile const founders = read_founders(path);
    std::string story = fmt::format("{}\n{}\n", founders.kind, founders.origin);
    for (Genome const& genome : founders.genomes) story += told(genome) + "\n";
    return story;
}

std::string array_told(std::string const& path) {
    NpyArray const array = read_npy(path);
    return fmt::format("{}\n{}\n", fmt::join(array.shape, " "), fmt::join(array.values, " "));
}

std::string trace_told(std::string const& path) {
    static Arena const arena = load_arena("collectball", "source");
    return trace_csv(read_trace_csv(path, arena));
}

std::string progress_told(std::string const& path) {
    std::string story;
    for (GenerationSummary const& row : read_progress(path)) story += text(row) + "\n";
    return story;
}

std::string manifest_told(std::string const& path) {
    Scratch const scratch;   // written again, it must say the same
    write_manifest(scratch.file("again"), read_manifest(path));
    auto const bytes = read_file(scratch.file("again"));
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

/// Settings may be added, so only those that the file holds count: as the reader then differs from the defaults.
std::string config_told(std::string const& path) {
    return fmt::format("differs: {}\n", text(differing_settings(read_config(path), {})));
}

std::string arena_told(std::string const& path) {
    Arena const arena = load_arena(path, "target");
    return fmt::format("{} {} x {}, {} walls, {} doors, {} lights, {} balls, pause {}\n", arena.name, arena.width,
                       arena.height, arena.walls.size(), arena.doors.size(), arena.basket_lights.size(),
                       arena.task.ball_positions.size(), arena.task.switch_pause);
}

struct Kind {
    std::function<std::string(std::string const&)> tell;
    bool checksummed;                                    ///< no change goes unnoticed
    std::function<void(std::string const&)> read = {};   ///< where telling does more than reading
};

std::map<std::string, Kind> const kinds{{run_file::lineage, {lineage_told, true}},
                                        {run_file::checkpoint, {checkpoint_told, true}},
                                        {run_file::all_individuals, {all_told, true}},
                                        {run_file::failed_genome, {genome_told, true}},
                                        {sample_founders, {founders_told, true}},
                                        {sample_knowledge, {knowledge_told, true}},
                                        {sample_array, {array_told, false}},
                                        {sample_trace, {trace_told, false}},
                                        {sample_packed_trace, {trace_told, false}},
                                        {run_file::progress, {progress_told, false}},
                                        {run_file::manifest, {manifest_told, false, read_manifest}},
                                        {run_file::config, {config_told, false}},
                                        {run_file::arena, {arena_told, false}}};

/// Every byte; of arenas only some, because whatever is still an arena is surveyed.
std::size_t stride(std::string const& file) { return file == run_file::arena ? 97 : 1; }

std::string text_of(std::filesystem::path const& path) {
    auto const bytes = read_file(path);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

/// Whether the reader takes this content; anything but an Error ends the test.
bool is_taken(Scratch const& scratch, Kind const& kind, std::string const& content) {
    std::string const path = scratch.file("damaged");
    std::filesystem::remove(path);   // ext4 writes at once what replaces a file's former content
    std::ofstream{path, std::ios::binary} << content;
    try {
        if (kind.read) kind.read(path);
        else kind.tell(path);
        return true;
    } catch (Error const&) { return false; }
}

}   // namespace

TEST(StoredFiles, of_version_1_are_read_and_say_what_was_written) {
    if (std::getenv("LORE_RENEW_STORED_FILES") != nullptr) {
        write_sample_files(stored);
        for (auto const& [file, kind] : kinds)
            write_file_atomically(stored / (file + ".txt"), std::string_view{kind.tell(stored / file)});
        GTEST_SKIP() << "written anew";
    }
    for (auto const& [file, kind] : kinds)
        EXPECT_EQ(kind.tell(stored / file), text_of(stored / (file + ".txt"))) << file;
}

TEST(StoredFiles, cut_at_any_length_are_refused_or_still_make_sense) {
    Scratch const scratch;
    for (auto const& [file, kind] : kinds) {
        std::string const whole = text_of(stored / file);
        std::size_t taken = 0;
        for (std::size_t length = 0; length < whole.size(); length += stride(file))
            taken += is_taken(scratch, kind, whole.substr(0, length));
        if (kind.checksummed && file != run_file::all_individuals) { EXPECT_EQ(taken, 0u) << file; }
        // An archive of all individuals grows: it may end after any frame, its head included.
        if (file == run_file::all_individuals) { EXPECT_EQ(taken, 1u); }
        if (file == sample_array || file == sample_packed_trace) { EXPECT_EQ(taken, 0u) << file; }
    }
}

TEST(StoredFiles, with_any_byte_changed_are_refused_or_still_make_sense) {
    Scratch const scratch;
    for (auto const& [file, kind] : kinds) {
        std::string content = text_of(stored / file);
        for (std::size_t at = 0; at < content.size(); at += stride(file))
            for (char const change : {'\x01', '\xff'}) {
                content[at] = static_cast<char>(content[at] ^ change);
                bool const taken = is_taken(scratch, kind, content);
                if (kind.checksummed) { EXPECT_FALSE(taken) << file << " at " << at; }
                content[at] = static_cast<char>(content[at] ^ change);
            }
    }
}

TEST(StoredFiles, of_a_newer_version_are_refused_politely) {
    Scratch const scratch;
    for (auto const& [file, kind] : kinds) {
        if (!kind.checksummed) continue;
        std::string content = text_of(stored / file);
        content[8] = 2;
        std::ofstream{scratch.file("newer"), std::ios::binary} << content;
        try {
            kind.tell(scratch.file("newer"));
            ADD_FAILURE() << file;
        } catch (Error const& error) {
            EXPECT_NE(std::string{error.what()}.find("written by a newer Lore: format 2, this one reads 1"),
                      std::string::npos)
                << error.what();
        }
    }
}
