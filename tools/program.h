#pragma once

#include "main.h"

#include <lore/core/error.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lore {

/// Decimal digits of 64 bits, for seeds: CLI11 alone reads 0x10, turns -1 into 2^64 - 1, and so does the rest of what
/// is too large.
inline CLI::Validator const seed_digits{
    [](std::string& text) {
        std::uint64_t seed = 0;
        auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), seed);
        bool const good = failed == std::errc{} && end == text.data() + text.size();
        return good ? std::string{} : fmt::format("'{}' is no whole number from 0 to 2^64 - 1", text);
    },
    ""};

/// An option whose value is empty comes from a variable that is not set; as if it were not there, it would change what
/// is done without a word.
inline void refuse_empty_values(CLI::App const& app) {
    for (CLI::Option const* const option : app.get_options()) {
        auto const& values = option->results();
        if (std::find(values.begin(), values.end(), "") != values.end())
            throw UsageError(fmt::format("{} is empty", option->get_name()), "a value is expected",
                             "Give one, or leave it out.");
    }
    for (CLI::App const* const command : app.get_subcommands()) refuse_empty_values(*command);
}

/// Parses the command line; returns an exit code where there is nothing else to do (--help, --version).
/// Throws UsageError for a mistake.
inline std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        refuse_empty_values(app);
        return std::nullopt;
    } catch (CLI::Success const& help) { return app.exit(help); } catch (CLI::ParseError const& error) {
        // What is missing is often there, misspelt.
        std::vector<std::string> const unknown = app.remaining(true);
        std::string const what = error.what();
        throw UsageError("cannot read the command line",
                         unknown.empty() ? what.substr(0, what.find('\n'))
                                         : fmt::format("'{}' was not expected", unknown.front()),
                         fmt::format("See '{} --help'.", app.get_name()));
    }
}

}   // namespace lore
