#include <lore/core/file.h>

#include "support/scratch.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

using namespace lore;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

namespace {

void touch(std::string const& path) {
    fs::create_directories(fs::path{path}.parent_path());
    std::ofstream{path} << "x";
}

}   // namespace

TEST(IsThere, tells_files_directories_and_what_is_not_there_and_says_where_it_cannot) {
    Scratch const scratch;
    touch(scratch.file("file"));
    EXPECT_TRUE(is_there(scratch.file("file")));
    EXPECT_TRUE(is_there(scratch.file("")));
    EXPECT_FALSE(is_there(scratch.file("nothing")));
    EXPECT_THROW(is_there(std::string(300, 'x')), Error) << "no file system has such a name";
}

TEST(MakeDirectory, makes_those_above_it_and_leaves_one_that_is_there) {
    Scratch const scratch;
    make_directory(scratch.file("a/b"));
    touch(scratch.file("a/b/file"));
    make_directory(scratch.file("a/b"));
    EXPECT_TRUE(fs::exists(scratch.file("a/b/file")));
}

TEST(MakeDirectory, says_why_it_cannot) {
    Scratch const scratch;
    touch(scratch.file("file"));
    for (std::string const& path : {scratch.file("file"), scratch.file("file/below"), std::string{"/proc/nothing"}}) {
        try {
            make_directory(path);
            ADD_FAILURE() << path;
        } catch (Error const& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::failure);
            EXPECT_THAT(error.what(), HasSubstr("cannot make the directory " + path + " ("));
        }
    }
}

TEST(CurrentPath, of_a_file_that_has_moved_is_its_new_place_and_said_once) {
    Scratch const scratch;
    touch(scratch.file("jobs/tasks/source.toml"));
    touch(scratch.file("jobs/campaigns/paper.toml"));
    touch(scratch.file("jobs/tasks/arenas/room.toml"));
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(current_path(scratch.file("jobs/source.toml")), scratch.file("jobs/tasks/source.toml"));
    EXPECT_EQ(current_path(scratch.file("jobs/source.toml")), scratch.file("jobs/tasks/source.toml"));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), scratch.file("jobs/source.toml") + " has moved to " +
                                                            scratch.file("jobs/tasks/source.toml") +
                                                            "; the old name works in every 1.x, not in 2.\n");
    EXPECT_EQ(current_path(scratch.file("jobs/paper.toml")), scratch.file("jobs/campaigns/paper.toml"));
    EXPECT_EQ(current_path(scratch.file("jobs/arenas/room.toml")), scratch.file("jobs/tasks/arenas/room.toml"));
}

TEST(CurrentPath, of_any_other_file_is_its_own) {
    Scratch const scratch;
    for (char const* const file :
         {"both.toml", "tasks/both.toml", "two.toml", "tasks/two.toml", "campaigns/two.toml", "tasks/data.csv"})
        touch(scratch.file(file));
    fs::remove(scratch.file("two.toml"));
    ::testing::internal::CaptureStderr();
    for (char const* const file : {"both.toml", "tasks/both.toml", "two.toml", "none.toml", "data.csv"})
        EXPECT_EQ(current_path(scratch.file(file)), scratch.file(file));
    EXPECT_EQ(current_path(""), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}
