#pragma once

#include <lore/core/error.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <optional>

namespace lore {

/// The body of main() for programs without MPI: catches everything, says it once, in one line, and returns the exit code.
template <class Run>
int run_program(char const* name, Run&& run) {
    auto const complain = [&](char const* what, ExitCode code) {
        std::fflush(stdout);
        fmt::print(stderr, "{}: {}\n", name, what);
        return static_cast<int>(code);
    };
    try {
        int const code = run();
        if (std::fflush(stdout) != 0) return complain("cannot write the result to stdout", ExitCode::failure);
        return code;
    } catch (Error const& error) {
        return complain(error.what(), error.exit_code());
    } catch (std::bad_alloc const&) {
        return complain("out of memory", ExitCode::failure);
    } catch (std::exception const& error) {
        return complain(error.what(), ExitCode::failure);
    }
}

/// Parses the command line; returns an exit code where there is nothing else to do (--help, --version).
/// Throws UsageError for a mistake.
inline std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        return std::nullopt;
    } catch (CLI::Success const& help) {
        return app.exit(help);
    } catch (CLI::ParseError const& error) {
        throw UsageError("cannot read the command line", error.what(), fmt::format("See '{} --help'.", app.get_name()));
    }
}

} // namespace lore
