// Files of the format versions so far, kept in tests/data: every later version reads them, and finds in them what was
// written.
//
// LORE_RENEW_STORED_FILES=1 writes those of version 2 anew, into the source tree; only right as long as it is not
// released.

#include "archive/random_population.h"
#include "support/sample_archive.h"
#include "support/scratch.h"
#include "support/told_files.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>

using namespace lore;
using namespace lore::test;

namespace {

namespace fs = std::filesystem;

fs::path const data{LORE_SOURCE_DIR "/tests/data"};

using Tell = std::string (*)(std::string const& path);
std::map<std::string, Tell> const tellers{
    {"all.lore", all_told},           {"checkpoint.lore", checkpoint_told}, {"failed-genome.lore", genome_told},
    {"founders.lore", founders_told}, {"lineage.lore", lineage_told},       {"sample.lorekb", knowledge_told}};

std::map<std::string, WorldRecord> const& worlds_of_version_2() {
    static std::map<std::string, WorldRecord> const worlds{{"collectball", robots_world()}, {"toy", toys_world()}};
    return worlds;
}

std::string text_of(fs::path const& path) {
    auto const bytes = read_file(path);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

void write_anew() {
    for (auto const& [name, world] : worlds_of_version_2()) {
        fs::path const directory = data / "version-2" / name;
        write_sample_archive(directory, world);
        for (auto const& [file, tell] : tellers)
            write_file_atomically(directory / (file + ".txt"), std::string_view{tell(directory / file)});
    }
}

/// Whether the reader takes this content; anything but an Error ends the test.
bool is_taken(Scratch const& scratch, Tell tell, std::string const& content) {
    std::string const path = scratch.file("damaged");
    fs::remove(path);   // ext4 writes at once what replaces a file's former content
    std::ofstream{path, std::ios::binary} << content;
    try {
        tell(path);
        return true;
    } catch (Error const&) { return false; }
}

}   // namespace

TEST(StoredArchive, of_version_1_is_read_as_collectball_s_and_says_what_was_written) {
    fs::path const directory = data / "version-1";
    for (auto const& [file, tell] : tellers) {
        Tell const really = tell == static_cast<Tell>(knowledge_told) ? knowledge_told_of_version_1 : tell;
        EXPECT_EQ(really(directory / file), text_of(directory / (file + ".txt"))) << file;
    }
    Channels const& channels = collectball_channels();
    EXPECT_EQ(read_lineage(directory / "lineage.lore").world.channels, channels);
    EXPECT_EQ(read_lineage(directory / "lineage.lore").world.reward_unit, "balls");
    EXPECT_EQ(why_other(read_lineage(directory / "lineage.lore").world, robots_world()), "");
    EXPECT_EQ(read_founders(directory / "founders.lore").genomes.size(), 2u);
    EXPECT_EQ(read_founders(directory / "founders.lore").world.channels, channels);
    EXPECT_EQ(read_knowledge_base(directory / "sample.lorekb").config().channels, channels);
    EXPECT_EQ(check_all_individuals(directory / "all.lore").world.channels, channels);
    Checkpoint const checkpoint =
        unpack_checkpoint(read_container(directory / "checkpoint.lore", FileKind::checkpoint), "x");
    EXPECT_EQ(checkpoint.state.population.members[0].descriptors->channels(), channels.count());
}

TEST(StoredArchive, of_version_1_may_grow_on) {
    // The archive of all individuals as its checkpoint knows it, and a generation more.
    Scratch const scratch;
    fs::path const directory = data / "version-1" / "stopped-run";
    Checkpoint const checkpoint =
        unpack_checkpoint(read_container(directory / "checkpoint.lore", FileKind::checkpoint), "x");
    std::string const path = scratch.file("all.lore");
    fs::copy_file(directory / "all.lore", path);
    AllIndividualsWriter writer{path, checkpoint.all_individuals, checkpoint.state.population};
    PretendedEvaluator evaluator;
    int const last = checkpoint.state.population.generation;
    double best = 0;
    evolve(small_evolution(last + 1), 1, evaluator, checkpoint.state, [&](GenerationReport const& report) {
        writer.add(report);
        for (Individual const& child : report.born) best = std::max(best, child.birth->reward);
        return true;
    });
    writer.finish();
    double found = 0;
    for_each_individual(path, last + 1, [&](ArchivedIndividual const& one) {
        if (one.id.generation == static_cast<std::uint32_t>(last) + 1) found = std::max(found, one.reward);
    });
    EXPECT_EQ(found, best);
    EXPECT_EQ(check_all_individuals(path).generations, last + 2);
}

TEST(StoredArchive, of_version_2_is_read_and_says_what_was_written) {
    if (std::getenv("LORE_RENEW_STORED_FILES") != nullptr) {
        write_anew();
        GTEST_SKIP() << "written anew";
    }
    for (auto const& [name, world] : worlds_of_version_2()) {
        fs::path const directory = data / "version-2" / name;
        for (auto const& [file, tell] : tellers)
            EXPECT_EQ(tell(directory / file), text_of(directory / (file + ".txt"))) << name << " " << file;
        EXPECT_EQ(read_lineage(directory / "lineage.lore").world, world);
    }
}

TEST(StoredArchive, of_version_2_is_written_with_the_same_bytes_again) {
    Scratch const scratch;
    for (auto const& [name, world] : worlds_of_version_2()) {
        write_sample_archive(scratch.file(name), world);
        for (auto const& [file, tell] : tellers)
            EXPECT_EQ(read_file(fs::path{scratch.file(name)} / file), read_file(data / "version-2" / name / file))
                << name << " " << file;
    }
}

TEST(StoredArchive, cut_at_any_length_or_with_any_byte_changed_is_refused) {
    Scratch const scratch;
    for (auto const& [file, tell] : tellers) {
        std::string content = text_of(data / "version-2" / "toy" / file);
        std::size_t taken = 0;
        for (std::size_t length = 0; length < content.size(); ++length)
            taken += is_taken(scratch, tell, content.substr(0, length));
        // An archive of all individuals grows: it may end after any frame, its head included.
        EXPECT_EQ(taken, file == "all.lore" ? 1u : 0u) << file;
        for (std::size_t at = 0; at < content.size(); ++at) {
            content[at] = static_cast<char>(content[at] ^ 0x11);
            EXPECT_FALSE(is_taken(scratch, tell, content)) << file << " at " << at;
            content[at] = static_cast<char>(content[at] ^ 0x11);
        }
    }
}
