#include <lore/world/open.h>

#include <lore/core/checksum.h>
#include <lore/core/toml.h>

#include "support/c_worlds.h"
#include "support/complaint.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lore {
namespace {

namespace fs = std::filesystem;
using test::c_world;
using test::complaint_of;
using ::testing::HasSubstr;

/// A built-in world that is a library all the same.
std::unique_ptr<World> open_trial(std::string const& task, std::string const& settings) {
    if (task != "plain") throw UsageError("no such task", task, "");
    return load_world(c_world("trial"), settings);
}
constexpr std::array builtins{BuiltinWorld{"inside", open_trial}};

/// Folders with and without the trial world, and no LORE_WORLD_PATH.
class OpenWorld : public ::testing::Test {
protected:
    OpenWorld() {
        ::unsetenv("LORE_WORLD_PATH");
        for (char const* folder : {"config", "first", "second"}) fs::create_directory(scratch.file(folder));
    }
    ~OpenWorld() override { ::unsetenv("LORE_WORLD_PATH"); }
    void put(std::string const& file) { fs::copy_file(c_world("trial"), scratch.file(file)); }

    Scratch scratch;
};

TEST_F(OpenWorld, looks_beside_the_configuration_then_along_the_path) {
    ::setenv("LORE_WORLD_PATH", (scratch.file("first") + "::" + scratch.file("second") + ":").c_str(), 1);
    put("second/libmine.so");
    EXPECT_EQ(find_library("mine", scratch.file("config")), scratch.file("second/libmine.so"));
    put("first/mine.so");
    EXPECT_EQ(find_library("mine", scratch.file("config")), scratch.file("first/mine.so"));
    EXPECT_EQ(find_library("libmine.so", scratch.file("config")), scratch.file("second/libmine.so"));
    put("config/libmine.so");
    EXPECT_EQ(find_library("mine", scratch.file("config")), scratch.file("config/libmine.so"));
}

TEST_F(OpenWorld, takes_a_path_from_the_folder_of_the_configuration) {
    put("second/mine.so");
    EXPECT_EQ(find_library("../second/mine.so", scratch.file("config")), scratch.file("config/../second/mine.so"));
    EXPECT_EQ(find_library(scratch.file("second/mine.so"), "elsewhere"), scratch.file("second/mine.so"));
    EXPECT_THAT(complaint_of<UsageError>([&] { find_library("./mine.so", scratch.file("config")); }),
                HasSubstr("No such file or directory"));
}

TEST_F(OpenWorld, says_where_it_has_looked) {
    ::setenv("LORE_WORLD_PATH", scratch.file("first").c_str(), 1);
    fs::create_directory(scratch.file("first/mine.so"));   // no file
    std::string const complaint = complaint_of<UsageError>([&] { find_library("mine", scratch.file("config")); });
    EXPECT_THAT(complaint, HasSubstr("there is no mine.so or libmine.so in " + scratch.file("config") + ", " +
                                     scratch.file("first") + ", "));
    EXPECT_THAT(complaint, HasSubstr("lore/worlds"));
}

TEST_F(OpenWorld, keeps_where_a_library_came_from) {
    put("config/mine.so");
    OpenedWorld const opened = open_world({"mine", "fault = \"alone\"\n", scratch.file("config")}, builtins);
    EXPECT_EQ(opened.origin.file, scratch.file("config/mine.so"));
    EXPECT_EQ(opened.origin.checksum, checksum_of_file(c_world("trial")));
    EXPECT_EQ(opened.origin.bytes, fs::file_size(c_world("trial")));
    EXPECT_EQ(opened.origin.settings, "fault = \"alone\"\n");
    EXPECT_EQ(opened.world->facts().max_batch, 1);
}

TEST_F(OpenWorld, knows_built_in_worlds_by_name_and_task) {
    OpenedWorld const opened = open_world({"inside:plain", "", ""}, builtins);
    EXPECT_EQ(opened.origin.file, "");
    EXPECT_EQ(opened.world->facts().name, "trial");
    EXPECT_THAT(complaint_of<UsageError>([] { open_world({"inside:other", "", ""}, builtins); }), HasSubstr("other"));
    EXPECT_THAT(complaint_of<UsageError>([] {
                    open_world({"insode:plain", "", ""}, builtins);
                }),
                HasSubstr("Did you mean 'inside'?"));
}

TEST_F(OpenWorld, leaves_a_built_in_world_that_refuses_long_settings_with_the_reason) {
    std::string const settings = "color = \"" + std::string(100, 'x') + "\"\n";
    EXPECT_THAT(complaint_of<UsageError>([&] {
                    open_world({"inside:other", settings, ""}, builtins);
                }),
                HasSubstr("no such task"));
}

TEST_F(OpenWorld, keeps_which_files_a_process_came_from) {
    std::string const script = std::string{LORE_SOURCE_DIR} + "/tests/support/worlds/trial_process.py";
    fs::copy_file(script, scratch.file("config/mine.py"));
    WorldRequest request{"", "", scratch.file("config")};
    request.process = {LORE_PYTHON, "-IS", "mine.py"};
    std::string const called = std::string{LORE_PYTHON} + " -IS mine.py";
    OpenedWorld const opened = open_world(request, builtins);
    EXPECT_EQ(opened.origin.file, "");
    EXPECT_EQ(opened.origin.command, request.process);
    EXPECT_EQ(text(opened.origin), called);
    // The interpreter is named by its path, so it is one of the files.
    EXPECT_EQ(opened.origin.checksum,
              checksum(checksum_text(checksum_of_file(LORE_PYTHON)) + checksum_text(checksum_of_file(script))));
    request.process = {"sh", "-c", "exec " + called};
    EXPECT_EQ(open_world(request, builtins).origin.bytes, 0u) << "no word is a file";
    request.process = {"./mine", "mine.py"};
    std::ofstream{scratch.file("config/mine")} << "#!/bin/sh\nexec " << LORE_PYTHON << " -IS \"$@\"\n";
    fs::permissions(scratch.file("config/mine"), fs::perms::owner_all);
    EXPECT_EQ(open_world(request, builtins).origin.bytes,
              fs::file_size(script) + fs::file_size(scratch.file("config/mine")));
    EXPECT_EQ(files_of({"python3", "-B", "mine.py", "--fast"}, scratch.file("config")),
              std::vector{scratch.file("config/mine.py")});
}

TEST(TomlLines, are_values_as_toml_writes_them_in_the_order_of_the_alphabet) {
    auto const lines = [](std::string const& text) { return TomlTable::parse(text, "test").lines(); };
    EXPECT_EQ(lines(""), "");
    EXPECT_EQ(
        lines("z = 1\nb = 0.1\nf = 2.0\nbig = 1e300\nok = false\nt = \"a \\\"b\\\"\\n\"\nn = [1, [2.5, \"x\"], []]\n"
              "[inner]\nkey = -3\n"),
        "b = 0.1\nbig = 1e+300\nf = 2.0\ninner.key = -3\nn = [1, [2.5, \"x\"], []]\nok = false\n"
        "t = \"a \\\"b\\\"\\n\"\nz = 1\n");
    EXPECT_THAT(complaint_of<UsageError>([&] { lines("d = 1979-05-27\n"); }), HasSubstr("d (it is neither a number"));
    EXPECT_THAT(complaint_of<UsageError>([&] { lines("\"a b\" = 1\n"); }), HasSubstr("not of letters"));
    EXPECT_THAT(complaint_of<UsageError>([&] { lines("a = [{b = 1}]\n"); }), HasSubstr("neither a number"));
}

}   // namespace
}   // namespace lore
