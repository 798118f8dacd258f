#include <lore/experiment/manifest.h>

#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

Manifest example() {
    Manifest manifest;
    manifest.status = RunStatus::interrupted;
    manifest.name = "source";
    manifest.seed = 0xffffffffffffffffu;
    manifest.signature = "0123456789abcdef";
    manifest.generation = 12;
    manifest.best = "3.4";
    manifest.build = build_information();
    manifest.inputs = {{"configuration", "jobs/tasks/source.toml", 10, "00"}};
    manifest.sessions.push_back(
        {"lore-evolve \"a\\b\" \xff", "2025-01-01T00:00:00Z", "", 0, 12, 2, {"a", "b"}, "v4", 1.25, "signal 10"});
    return manifest;
}

std::string text(std::string const& path) {
    auto const bytes = read_file(path);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

}   // namespace

TEST(Manifest, comes_back_as_it_was_written) {
    Scratch const scratch;
    write_manifest(scratch.file("m.json"), example());
    Manifest const read = read_manifest(scratch.file("m.json"));
    EXPECT_EQ(read.status, RunStatus::interrupted);
    EXPECT_EQ(read.seed, 0xffffffffffffffffu);
    EXPECT_EQ(read.signature, "0123456789abcdef");
    EXPECT_EQ(read.build.libraries, example().build.libraries);
    ASSERT_EQ(read.sessions.size(), 1u);
    EXPECT_EQ(read.sessions[0].hosts, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(read.sessions[0].seconds, 1.25);
    ASSERT_NE(find_role(read.inputs, "configuration"), nullptr);
    EXPECT_EQ(find_role(read.inputs, "configuration")->bytes, 10u);
    EXPECT_EQ(find_role(read.inputs, "arena"), nullptr);
}

TEST(Manifest, is_refused_when_cut_anywhere_or_of_a_newer_format) {
    Scratch const scratch;
    write_manifest(scratch.file("m.json"), example());
    std::string const whole = text(scratch.file("m.json"));
    for (std::size_t length = 0; length + 2 < whole.size(); length += 7) {
        FILE* const file = std::fopen(scratch.file("cut.json").c_str(), "wb");
        std::fwrite(whole.data(), 1, length, file);
        std::fclose(file);
        EXPECT_THROW(read_manifest(scratch.file("cut.json")), Error) << length;
    }
    std::string newer = whole;
    newer.replace(newer.find("\"format\": 1"), 11, "\"format\": 9");
    write_file_atomically(scratch.file("newer.json"), std::string_view{newer});
    try {
        read_manifest(scratch.file("newer.json"));
        FAIL();
    } catch (Error const& error) {
        EXPECT_THAT(error.what(), HasSubstr("written by a newer Lore: format 9, this one reads 1"));
    }
}

TEST(Manifest, is_refused_where_a_whole_number_is_none_or_too_large) {
    Scratch const scratch;
    write_manifest(scratch.file("m.json"), example());
    std::string const whole = text(scratch.file("m.json"));
    for (char const* const number : {"1e300", "12.5", "5000000000", "-5000000000", "true", "null"}) {
        std::string changed = whole;
        changed.replace(changed.find("\"generation\": 12"), 16, std::string{"\"generation\": "} + number);
        write_file_atomically(scratch.file("changed.json"), std::string_view{changed});
        EXPECT_THROW(read_manifest(scratch.file("changed.json")), Error) << number;
    }
}

TEST(Manifest, is_refused_where_it_is_nested_deeper_than_the_stack_could_follow) {
    Scratch const scratch;
    write_manifest(scratch.file("m.json"), example());
    std::string const deep = "\"deep\": " + std::string(200'000, '[') + std::string(200'000, ']') + ",";
    write_file_atomically(scratch.file("deep.json"), std::string_view{text(scratch.file("m.json")).insert(1, deep)});
    try {
        read_manifest(scratch.file("deep.json"));
        FAIL();
    } catch (Error const& error) { EXPECT_THAT(error.what(), HasSubstr("it is nested too deeply")); }
}

TEST(Version, names_program_compiler_instruction_set_and_libraries) {
    std::string const version = version_text("lore-evolve");
    for (char const* const word :
         {"lore-evolve 1.", "commit", "compiled by", "instruction set", "\nBoost 1.", "zstd 1."})
        EXPECT_THAT(version, HasSubstr(word));
}

TEST(TimeStamp, is_utc_in_iso_8601) {
    EXPECT_THAT(time_stamp(), ::testing::ContainsRegex("^20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-9:]{8}Z$"));
}
