#include <lore/core/directory.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

#include <fstream>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

namespace fs = std::filesystem;

namespace {

std::vector<std::string> paths_of(std::vector<DirectoryEntry> const& entries) {
    std::vector<std::string> paths;
    for (DirectoryEntry const& entry : entries) paths.push_back(entry.path);
    return paths;
}

}   // namespace

TEST(Directory, tells_what_lies_in_it_and_below_it_but_not_through_links) {
    Scratch const scratch;
    fs::create_directories(scratch.file("d/e"));
    std::ofstream{scratch.file("d/e/f")} << "";
    fs::create_symlink("e", scratch.file("d/link"));
    EXPECT_THAT(paths_of(entries_in(scratch.file("d"))),
                UnorderedElementsAre(scratch.file("d/e"), scratch.file("d/link")));
    EXPECT_THAT(paths_of(entries_below(scratch.file("d"))),
                UnorderedElementsAre(scratch.file("d/e"), scratch.file("d/link"), scratch.file("d/e/f")));
    for (DirectoryEntry const& entry : entries_in(scratch.file("d")))
        EXPECT_EQ(entry.type, entry.path.ends_with("link") ? fs::file_type::symlink : fs::file_type::directory);
    EXPECT_THAT(entries_in(scratch.file("d/e")),
                ElementsAre(testing::Field(&DirectoryEntry::type, fs::file_type::regular)));
}

TEST(Directory, that_cannot_be_read_is_told_of_in_a_line) {
    Scratch const scratch;
    std::ofstream{scratch.file("f")} << "";
    EXPECT_EQ(test::complaint_of([&] { entries_below(scratch.file("none")); }),
              "cannot read " + scratch.file("none") + " (No such file or directory). Check the path.");
    EXPECT_EQ(test::complaint_of([&] { entries_in(scratch.file("f")); }),
              "cannot read " + scratch.file("f") + " (Not a directory). Check the path.");
}

TEST(Directory, loses_a_file_that_is_there_and_tells_of_one_that_cannot_be_removed) {
    Scratch const scratch;
    fs::create_directories(scratch.file("d/e"));
    std::ofstream{scratch.file("f")} << "";
    remove_file(scratch.file("f"));
    remove_file(scratch.file("f"));
    EXPECT_FALSE(fs::exists(scratch.file("f")));
    EXPECT_EQ(test::complaint_of([&] { remove_file(scratch.file("d")); }),
              "cannot remove " + scratch.file("d") + " (Directory not empty). Check the disk.");
}
