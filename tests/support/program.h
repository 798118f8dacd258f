#pragma once

#include "support/scratch.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
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

/// Tests of one of Lore's programs, which runs in a directory of its own.
class ProgramTest : public ::testing::Test {
protected:
    explicit ProgramTest(std::string program) : program_(std::move(program)) {}

    Ran run(std::string const& arguments) {
        return run_program("cd " + scratch.path() + " && " + program_ + " " + arguments, scratch.path());
    }
    void expect_done(std::string const& arguments) {
        Ran const ran = run(arguments);
        EXPECT_EQ(ran.exit_code, 0) << arguments << ": " << ran.errors;
    }
    /// One line on stderr, that exit code, no other output, and the file or directory "never" not written.
    void expect_refusal(std::string const& arguments, int exit_code, std::string const& saying) {
        Ran const ran = run(arguments);
        EXPECT_EQ(ran.exit_code, exit_code) << arguments;
        EXPECT_THAT(ran.errors, ::testing::StartsWith(std::filesystem::path{program_}.filename().string() + ": "));
        EXPECT_THAT(ran.errors, ::testing::HasSubstr(saying));
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
        EXPECT_EQ(ran.output, "");
        EXPECT_FALSE(std::filesystem::exists(scratch.file("never")));
    }

    void write(std::string const& file, std::string const& text) {
        std::ofstream{scratch.file(file), std::ios::binary} << text;
    }
    std::string content(std::string const& file) {
        std::ifstream stream{scratch.file(file), std::ios::binary};
        return {std::istreambuf_iterator<char>{stream}, {}};
    }

    Scratch scratch;

private:
    std::string program_;
};

}   // namespace lore::test
