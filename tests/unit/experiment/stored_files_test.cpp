// Files of format version 1, kept in tests/data: every later version reads them, and finds in them what was written.

#include "support/sample_files.h"
#include "support/scratch.h"
#include "support/told_files.h"

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
                                        {sample_knowledge, {knowledge_told_of_version_1, true}},
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
        content[8] = 3;
        std::ofstream{scratch.file("newer"), std::ios::binary} << content;
        try {
            kind.tell(scratch.file("newer"));
            ADD_FAILURE() << file;
        } catch (Error const& error) {
            EXPECT_NE(std::string{error.what()}.find("written by a newer Lore: format 3, this one reads 2"),
                      std::string::npos)
                << error.what();
        }
    }
}
