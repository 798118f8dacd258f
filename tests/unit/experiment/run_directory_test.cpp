#include <lore/experiment/run_directory.h>

#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

TEST(IndividualId, is_typed_and_read_as_generation_dot_slot) {
    EXPECT_EQ(text(IndividualId{312, 17}), "312.17");
    EXPECT_EQ(individual_id("312.17"), (IndividualId{312, 17}));
    for (char const* const bad : {"", "best", "3", "3.", ".3", "3.4.5", "3,4", "-1.2", "3.4 ", "99999999999.1"})
        EXPECT_THROW(individual_id(bad), UsageError) << bad;
}

TEST(RunDirectory, says_what_is_missing) {
    Scratch const scratch;
    auto const complaint = [](std::string const& path) {
        try {
            open_run(path);
        } catch (Error const& error) { return std::string{error.what()}; }
        return std::string{};
    };
    EXPECT_THAT(complaint(scratch.file("nowhere")), HasSubstr("no such directory"));
    EXPECT_THAT(complaint(scratch.path()), HasSubstr("there is no config.toml"));
    ExperimentConfig config;
    write_file_atomically(scratch.file("config.toml"), std::string_view{to_toml(config)});
    EXPECT_THAT(complaint(scratch.path()), HasSubstr("no lineage"));
}
