// Shows what the programs of Lore are for and what to type first, and starts them:
//
//   lore
//   lore evolve jobs/tasks/source.toml --seed 1 --out runs/s1       the same as lore-evolve ...

#include "main.h"

#include <lore/core/error.h>
#include <lore/core/installation.h>
#include <lore/experiment/version.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace {

using namespace lore;
namespace fs = std::filesystem;

struct Program {
    std::string_view name;
    std::string_view what;
};

constexpr Program programs[]{
    {"evolve", "one run of evolution, over MPI or alone"},
    {"kb", "builds, queries, combines and exports knowledge bases"},
    {"replay", "shows what an archived robot does: trace, pictures"},
    {"campaign", "plans, runs, submits, watches and reports campaigns"},
    {"world", "shows and checks worlds of your own"},
    {"bench", "benchmarks"},
};

/// That of the build or installation that this program belongs to; empty if it is not there.
std::string path_of(std::string_view name) {
    std::error_code ignored;
    fs::path const folder = fs::path{own_program()}.parent_path(), path = folder / fmt::format("lore-{}", name);
    return !folder.empty() && fs::exists(path, ignored) ? path.string() : "";
}

/// The first commands, as they work in the current directory.
std::string first_commands() {
    std::string const jobs = jobs_directory();
    bool const are_here = fs::exists("jobs/tasks/source.toml");
    std::string text = "Begin with\n";
    if (!are_here && !jobs.empty()) text += fmt::format("  cp -r {} .\n", jobs);
    text += "  lore evolve jobs/tasks/source.toml --seed 1 --out runs/s1 --set evolution.generations=300\n"
            "  lore kb build runs/s1 --out kb1.lorekb\n"
            "  lore replay runs/s1 --kb kb1.lorekb --out replay\n"
            "  lore kb reduce kb1.lorekb --top 1000 --out best.lorekb\n"
            "  lore evolve jobs/tasks/target.toml --founders best.lorekb --seed 1 --out runs/t1 "
            "--set evolution.generations=300\n";
    if (!jobs.empty())
        text += fmt::format("or, to see in a few minutes whether knowledge helps,\n  {}/quickstart\n",
                            are_here ? "jobs" : jobs);
    return text;
}

std::string overview() {
    std::string text =
        "Lore evolves controllers of a simulated robot, and hands knowledge from one task to the next.\n\n";
    for (Program const& program : programs)
        if (!path_of(program.name).empty()) text += fmt::format("  lore {:<10} {}\n", program.name, program.what);
    return text +
           "\n'lore evolve' starts lore-evolve, and so on; 'lore help evolve' shows its options and examples.\n\n" +
           first_commands();
}

/// Becomes the program; returns only by an exception.
[[noreturn]] void become(std::string_view name, std::vector<std::string> arguments) {
    std::string const path = path_of(name);
    if (path.empty()) {
        std::vector<std::string_view> names;
        for (Program const& program : programs)
            if (!path_of(program.name).empty()) names.push_back(program.name);
        std::string const meant = nearest_word(name, names.data(), names.size());
        throw UsageError(
            fmt::format("there is no program lore-{}", name), fmt::format("there are {}", fmt::join(names, ", ")),
            meant.empty() ? "'lore' says what they are for." : fmt::format("Did you mean 'lore {}'?", meant));
    }
    arguments.insert(arguments.begin(), path);
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    ::execv(path.c_str(), words.data());
    throw Error(fmt::format("cannot start {}", path), std::strerror(errno), "Install Lore again.");
}

int start(std::vector<std::string> words) {
    std::string const first = words.empty() ? "help" : words.front();
    bool const asks_for_help = first == "help" || first == "--help" || first == "-h";
    if (asks_for_help && words.size() < 2) {
        fmt::print("{}", overview());
    } else if (first == "--version") {
        fmt::print("{}\n", version_text("lore"));
    } else if (asks_for_help) {
        become(words[1], {"--help"});
    } else if (first.starts_with("-")) {
        throw UsageError("cannot read the command line", fmt::format("'{}' was not expected", first),
                         "See 'lore --help'.");
    } else {
        become(first, {words.begin() + 1, words.end()});
    }
    return static_cast<int>(ExitCode::done);
}

}   // namespace

int main(int argc, char** argv) {
    return run_program("lore", [&] { return start({argv + 1, argv + argc}); });
}
