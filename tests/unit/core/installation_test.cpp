#include <lore/core/installation.h>

#include "support/scratch.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace lore;

TEST(MissingFile, is_told_the_file_of_nearly_that_name) {
    Scratch const scratch;
    for (char const* const name : {"source.toml", "target.toml", "ab"}) std::ofstream{scratch.file(name)};
    EXPECT_EQ(remedy_for_missing(scratch.file("sorce.toml")), "Did you mean 'source.toml'?");
    EXPECT_EQ(remedy_for_missing(scratch.file("other.csv")), "Check the path.");
    EXPECT_EQ(remedy_for_missing(scratch.file("ac")), "Check the path.") << "short names are all like each other";
    EXPECT_EQ(remedy_for_missing(scratch.file("nowhere/source.toml")), "Check the path.");
    EXPECT_EQ(remedy_for_missing(""), "Check the path.");
}

TEST(JobsDirectory, is_empty_for_a_program_that_has_none) {
    EXPECT_EQ(jobs_directory(), "") << "a test lies deeper in a build folder than programs do";
}
