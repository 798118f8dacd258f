#pragma once

#include "support/command.h"

#include <lore/archive/atomic_file.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace lore {

/// A configuration that is quick to run and still has everything in it; written into the scratch directory.
inline std::string small_config(Scratch const& scratch, int generations = 40, std::string const& more = "") {
    std::string const path = scratch.file("small.toml");
    write_file_atomically(path, std::string_view{"name = \"small\"\narena = \"collectball\"\n"
                                                 "[episode]\nsteps = 400\n"
                                                 "[evolution]\npopulation = 16\nfounders = 32\ngenerations = " +
                                                 std::to_string(generations) +
                                                 "\n[diversity]\nperiod = 5\n[checkpoint]\ngenerations = 7\n" + more});
    return path;
}

inline std::vector<std::string> evolve(std::string const& config, std::string const& directory,
                                       std::vector<std::string> const& more = {}) {
    return std::vector<std::string>{program("lore-evolve"), config, "--out", directory, "--archive", "all", "-q"} +
           more;
}

/// The last line of stdout without its label, or "" if there is none.
inline std::string signature(Command const& command) {
    std::string const out = command.out();
    std::size_t const at = out.rfind("signature: ");
    if (at == std::string::npos || out.size() != at + 11 + 16 + 1) return "";
    return out.substr(at + 11, 16);
}

/// progress.csv without the column `seconds`, the only one that tells the time.
inline std::string timeless_progress(std::string const& directory) {
    std::istringstream lines{file_text(directory + "/progress.csv")};
    std::string kept;
    std::ptrdiff_t seconds = -1;   // the place of that column
    for (std::string line; std::getline(lines, line); kept += "\n") {
        if (seconds < 0)
            seconds = std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(line.find("seconds")), ',');
        std::istringstream fields{line};
        std::string field;
        for (std::ptrdiff_t at = 0; std::getline(fields, field, ','); ++at)
            if (at != seconds) kept += field + ",";
    }
    return kept;
}

/// Everything that must be equal to the byte however a run came to its end.
inline std::string results(std::string const& directory) {
    return timeless_progress(directory) + file_text(directory + "/lineage.lore") + file_text(directory + "/all.lore") +
           file_text(directory + "/config.toml") + file_text(directory + "/arena.toml");
}

/// Tests that run programs in a directory of their own.
class SystemTest : public ::testing::Test {
protected:
    void expect_done(std::vector<std::string> const& words) {
        Command command{scratch, words};
        ASSERT_EQ(command.wait(), 0) << command.err();
    }
    /// One line on stderr, and that exit code.
    void expect_refusal(std::vector<std::string> const& words, int code, std::string const& saying) {
        Command command{scratch, words};
        EXPECT_EQ(command.wait(), code);
        EXPECT_THAT(command.err(), ::testing::HasSubstr(saying));
        std::string const said = command.err();
        EXPECT_EQ(said.find('\n'), said.size() - 1) << said;
    }
    /// Of a run that must end well.
    std::string signature_of_run(std::vector<std::string> const& words) {
        Command command{scratch, words};
        EXPECT_EQ(command.wait(), 0) << command.err();
        return signature(command);
    }

    Scratch scratch;
};

inline bool exists(std::string const& path) { return std::filesystem::exists(path); }

}   // namespace lore
