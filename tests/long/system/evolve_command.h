#pragma once

#include "support/command.h"

#include <lore/archive/atomic_file.h>

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

inline bool exists(std::string const& path) { return std::filesystem::exists(path); }

}   // namespace lore
