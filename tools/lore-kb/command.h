#pragma once

#include "program.h"

#include <lore/archive/container.h>
#include <lore/experiment/run_directory.h>
#include <lore/knowledge/index.h>
#include <lore/knowledge/value.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lore::kb {

/// What all subcommands share.
struct Program {
    std::string command_line;
    bool quiet = false;
    std::function<void()> chosen;   ///< the subcommand that the command line asks for
};

/// Declares a subcommand and gives it options of its own, which live as long as `program`. Parsing a command line that
/// asks for it sets program.chosen to call `run`.
template <class Options>
CLI::App* add_command(CLI::App& app, Program& program, char const* name, char const* what,
                      std::shared_ptr<Options> options, void (*run)(Program const&, Options const&)) {
    CLI::App* const command = app.add_subcommand(name, what);
    command->callback(
        [&program, options, run] { program.chosen = [&program, options, run] { run(program, *options); }; });
    return command;
}

// One function a subcommand, in the file of its name.
void add_build(CLI::App&, Program&);
void add_info(CLI::App&, Program&);
void add_query(CLI::App&, Program&);
void add_product(CLI::App&, Program&);
void add_randomize(CLI::App&, Program&);
void add_revalue(CLI::App&, Program&);
void add_reduce(CLI::App&, Program&);
void add_export(CLI::App&, Program&);
void add_individuals(CLI::App&, Program&);
void add_clone(CLI::App&, Program&);
void add_verify(CLI::App&, Program&);

// Options that several subcommands have.
void add_base(CLI::App*, std::string& path);
void add_out(CLI::App*, std::string& path);
/// --index and --checks.
void add_index(CLI::App*, std::string& name, std::optional<int>& checks);
/// Throws UsageError for an unknown index, and for checks of an exact one.
IndexChoice index_choice(std::string const& name, std::optional<int> checks);
/// Left empty where it is not given: then 'best' is meant.
void add_individual(CLI::App*, std::optional<std::string>&);
/// --value RULE and --gamma G.
void add_value(CLI::App*, std::string& rule, std::optional<double>& gamma, bool required);
/// Refuses "nan", which CLI11 reads as a number within any range.
extern CLI::Validator const a_number;
/// Refuses infinity too.
extern CLI::Validator const a_finite_number;

/// Provenance::made_by: the command line and this version.
std::string made_by(Program const&);
/// Prints a line unless --quiet was given.
void say(Program const&, std::string const& line);
/// Throws UsageError or Error if a file cannot be written at `path`: before long work is done for it. A
/// file that is there already is written over only by one of its kind: `kind`, or none of Lore's.
void check_writable(std::string const& path, std::optional<FileKind> kind = std::nullopt);
/// Throws UsageError if windows of that length, of the knowledge base at `path`, are longer than the run's evaluations.
void require_length(int window_length, RunDirectory const&, std::string const& path);
/// The trace of an archived individual, by simulating it again. `individual` as RunDirectory::individual takes it.
Trace trace_of(RunDirectory const&, std::string const& individual);
/// Writes a derived knowledge base, which names the files it was made from.
void write_derived(Program const&, std::string const& out, KnowledgeBase const& derived,
                   std::vector<std::string> const& sources);

}   // namespace lore::kb
