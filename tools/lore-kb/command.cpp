#include "command.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/experiment/version.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace lore::kb {

CLI::Validator const a_number{[](std::string& text) {
                                  return std::isnan(std::strtod(text.c_str(), nullptr))
                                             ? fmt::format("'{}' is no number", text)
                                             : std::string{};
                              },
                              ""};

CLI::Validator const a_finite_number{[](std::string& text) {
                                         return std::isfinite(std::strtod(text.c_str(), nullptr))
                                                    ? std::string{}
                                                    : fmt::format("'{}' is no finite number", text);
                                     },
                                     ""};

void add_base(CLI::App* command, std::string& path) { command->add_option("KB", path, "knowledge base")->required(); }

void add_out(CLI::App* command, std::string& path) {
    command->add_option("--out", path, "knowledge base to write")->required();
}

void add_index(CLI::App* command, std::string& name, std::optional<int>& checks) {
    command->add_option("--index", name, "exact, or flann: approximate, and not repeatable from run to run")
        ->capture_default_str();
    command->add_option("--checks", checks, "of flann: leaves that a search looks at; FLANN's own default is 32")
        ->check(CLI::Range(1, 1000000000))
        ->default_str(std::to_string(usual_checks));
}

IndexChoice index_choice(std::string const& name, std::optional<int> checks) {
    IndexChoice const choice{index_kind(name), checks.value_or(usual_checks)};
    if (checks && choice.kind == IndexKind::exact)
        throw UsageError("the exact index has no --checks", "it finds every match", "Leave them out.");
    return choice;
}

void add_individual(CLI::App* command, std::optional<std::string>& id) {
    command->add_option("--individual", id, "'best', or GENERATION.SLOT")->type_name("ID")->default_str("best");
}

void add_value(CLI::App* command, std::string& rule, std::optional<double>& gamma, bool required) {
    CLI::Option* const option = command->add_option(
        "--value", rule,
        "rule that gives the values: mean (of the rewards of those who showed a feature), return (discounted, "
        "of the steps after it was shown), contrast (log-odds of success against contemporaries), credit (gain of "
        "children in which it is new)");
    if (required) option->required();
    else option->capture_default_str();
    command->add_option("--gamma", gamma, "of return: discount a step, between 0 and 1")
        ->default_str(fmt::format("{}", ValueConfig{}.gamma));
}

std::string made_by(Program const& program) {
    BuildInformation const build = build_information();
    return fmt::format("{} (Lore {}, commit {})", program.command_line, build.version, build.commit);
}

void say(Program const& program, std::string const& line) {
    if (!program.quiet) fmt::print("{}\n", line);
}

namespace {

/// A slip of the hand must not cost a base, or a run its table.
void refuse_another_kind(std::string const& path, std::optional<FileKind> kind) {
    std::filesystem::path const file{path};
    if (!std::filesystem::is_regular_file(file)) return;
    bool const in_run = std::filesystem::exists(file.parent_path() / run_file::config);
    for (char const* const own : {run_file::config, run_file::arena, run_file::manifest, run_file::progress})
        if (in_run && file.filename() == own)
            throw UsageError(fmt::format("cannot write {}", path), "it is a file of that run", "Choose another name.");
    std::optional<FileKind> there;
    try {
        there = kind_of_file(path);
    } catch (Error const&) { return; }   // none of Lore's
    if (there != kind)
        throw UsageError(fmt::format("cannot write {}", path), fmt::format("it is a {}", name(*there)),
                         "Choose another name, or move it away.");
}

}   // namespace

void check_writable(std::string const& path, std::optional<FileKind> kind) {
    refuse_another_kind(path, kind);
    std::filesystem::path const directory = std::filesystem::path{path}.parent_path();
    std::string const place = directory.empty() ? "." : directory.string();
    if (std::filesystem::is_directory(path))
        throw UsageError(fmt::format("cannot write {}", path), "it is a directory", "Name a file in it.");
    refuse_pipe_or_device(path);
    if (!directory.empty() && !std::filesystem::is_directory(directory))
        throw UsageError(fmt::format("cannot write {}", path),
                         fmt::format("there is no directory {}", directory.string()), "Make it first.");
    if (::access(place.c_str(), W_OK) != 0)
        throw Error(fmt::format("cannot write {}", path), fmt::format("{}: {}", place, std::strerror(errno)),
                    "Choose a place where you may write.");
}

void require_length(int window_length, RunDirectory const& run, std::string const& path) {
    if (int const steps = run.config.episode.steps; window_length > steps)
        throw UsageError(fmt::format("{} does not fit {}", path, run.path),
                         fmt::format("its windows have {} steps, an evaluation has {}", window_length, steps),
                         "Take one with shorter windows.");
}

Trace trace_of(RunDirectory const& run, std::string const& individual) {
    return record_episode(*run.world.world, compile(run.individual(individual)->genome), run.config.episode);
}

void write_derived(Program const& program, std::string const& out, KnowledgeBase const& derived,
                   std::vector<std::string> const& sources) {
    KnowledgeBase::Parts parts = derived.parts();
    parts.provenance.made_by = made_by(program);
    parts.provenance.derivation.insert(parts.provenance.derivation.end() - 1,
                                       fmt::format("read from {}", fmt::join(sources, ", ")));
    write_knowledge_base(out, KnowledgeBase{std::move(parts)});
    say(program, fmt::format("wrote {}: {} features", out, derived.size()));
}

}   // namespace lore::kb
