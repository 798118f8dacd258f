#pragma once

#include "main.h"

#include <lore/core/error.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
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

/// Makes an option of several values take one each time it is given. In the help, "..." is of those that take all that
/// follows.
inline void take_one_a_time(CLI::Option* option) {
    option->allow_extra_args(false)->option_text(option->get_type_name());
}

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

/// The names of the commands of a program, if it has some.
inline std::vector<std::string> command_names(CLI::App const& app) {
    std::vector<std::string> names;
    for (CLI::App const* const command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
    return names;
}

/// "lore-kb build" once `build` was understood: the program, or its command, whose --help has what was wanted.
inline std::string understood(CLI::App const& app) {
    auto const chosen = app.get_subcommands();
    return chosen.empty() ? app.get_name() : fmt::format("{} {}", app.get_name(), chosen.front()->get_name());
}

/// What to say of a word that nobody expects.
inline std::string remedy_for_unknown(CLI::App const& app, std::string const& typed) {
    std::vector<std::string> known;
    auto const chosen = app.get_subcommands();
    if (typed.starts_with("--")) {
        for (CLI::App const* const with_options : {&app, chosen.empty() ? &app : chosen.front()})
            for (CLI::Option const* const option : with_options->get_options())
                for (std::string const& name : option->get_lnames()) known.push_back("--" + name);
    } else if (chosen.empty()) {
        known = command_names(app);
    }
    std::vector<std::string_view> const words(known.begin(), known.end());
    std::string const meant = nearest_word(typed.substr(0, typed.find('=')), words.data(), words.size());
    std::string const help = fmt::format("'{} --help'", understood(app));
    return meant.empty() ? fmt::format("See {}.", help) : fmt::format("Did you mean '{}'? See {}.", meant, help);
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
        if (!unknown.empty())
            throw UsageError("cannot read the command line", fmt::format("'{}' was not expected", unknown.front()),
                             remedy_for_unknown(app, unknown.front()));
        std::vector<std::string> const commands = command_names(app);
        std::string const what = error.what();
        bool const wants_command =
            error.get_name() == "RequiredError" && !commands.empty() && app.get_subcommands().empty();
        throw UsageError("cannot read the command line",
                         wants_command ? fmt::format("a command is expected: {}", fmt::join(commands, ", "))
                                       : what.substr(0, what.find('\n')),
                         fmt::format("See '{} --help'.", understood(app)));
    }
}

}   // namespace lore
