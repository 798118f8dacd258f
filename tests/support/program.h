#pragma once

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>

namespace lore::test {

struct Ran {
    int exit_code = -1;
    std::string output;   ///< stdout
    std::string errors;   ///< stderr
};

/// Runs a shell command; stderr passes through a file in `scratch`.
inline Ran run_program(std::string const& command, std::string const& scratch) {
    std::string const errors_path = scratch + "/stderr.txt";
    Ran ran;
    FILE* const pipe = ::popen((command + " 2>" + errors_path).c_str(), "r");
    if (pipe == nullptr) return ran;
    char buffer[4096];
    for (std::size_t got; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) ran.output.append(buffer, got);
    int const status = ::pclose(pipe);
    ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::ifstream errors{errors_path};
    ran.errors.assign(std::istreambuf_iterator<char>{errors}, {});
    return ran;
}

} // namespace lore::test
