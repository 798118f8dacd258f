// Evolves controllers on a task, alone or on many ranks:
//
//   lore-evolve jobs/tasks/source.toml --seed 7 --out runs/source/007
//   mpirun -n 2 lore-evolve jobs/tasks/target.toml --founders best.lorekb --seed 7 --out runs/t1/007
//
// Writes configuration, provenance, progress, lineage and checkpoints into the directory (docs/manual/formats.md), and
// prints the run's signature. Interrupted, it stops at a checkpoint with exit code 75; --resume goes on from there.

#include "program.h"

#include <lore/core/error.h>
#include <lore/core/isa.h>
#include <lore/core/toml.h>
#include <lore/core/utf8.h>
#include <lore/experiment/run.h>
#include <lore/experiment/run_directory.h>
#include <lore/experiment/version.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

namespace {

using namespace lore;

constexpr char this_program[] = "lore-evolve";
constexpr char examples[] = R"(Examples:
  lore-evolve jobs/tasks/source.toml --seed 7 --out runs/source/007
  mpirun -n 2 lore-evolve jobs/tasks/source.toml --seed 7 --out runs/source/007 --resume
  lore-kb reduce kb1.lorekb --top 1000 --out best.lorekb
  mpirun -n 2 lore-evolve jobs/tasks/target.toml --founders best.lorekb --out runs/t1 --set evolution.generations=500
  mpirun -n 2 lore-evolve jobs/tasks/target.toml --founders best?.lorekb --out runs/t2
  lore-evolve --bench

Exit codes: 0 done, 75 stopped at a checkpoint (run it again with --resume), 2 command line, configuration or
the name of an input, 1 any other failure.)";

/// "HH:MM:SS", "MM:SS" or seconds.
double seconds_of(std::string const& text) {
    double total = 0;
    int parts = 0;
    for (std::size_t start = 0; start <= text.size(); ++parts) {
        std::size_t const end = std::min(text.find(':', start), text.size());
        unsigned part = 0;
        auto const [stop, error] = std::from_chars(text.data() + start, text.data() + end, part);
        bool const counts_on = parts > 0 && part >= 60;   // minutes and seconds behind a colon
        if (error != std::errc{} || stop != text.data() + end || parts == 3 || counts_on)
            throw UsageError(fmt::format("--max-time {}", text), "it is no time", "Write it like 01:30:00.");
        total = total * 60 + part;
        start = end + 1;
    }
    return total;
}

struct CommandLine {
    RunOptions run;
    bool bench = false;
    std::string archive = "lineage";
    std::string max_time;
};

/// Prints without throwing, unlike fmt::print; where that fails, says so and what to do.
ExitCode print_result(std::string const& text, std::string_view remedy) {
    std::fputs(text.c_str(), stdout);
    std::string const lost = lost_result(remedy);
    if (lost.empty()) return ExitCode::done;
    complain(this_program, lost, ExitCode::failure);
    return ExitCode::failure;
}

/// The rest of the program on rank 0, after the command line: 0 or 75.
ExitCode work(Session const& session, CommandLine& line) {
    if (line.bench) {
        BenchOutcome const bench = run_bench(session);
        return print_result(fmt::format("{:.0f} steps per second on {} rank(s)\nsignature: {}\n",
                                        bench.steps_per_second, session.size(), bench.signature),
                            "Send it where it can be written.");
    }
    RunOutcome const outcome = run_experiment(session, line.run);
    if (!outcome.finished) {
        write_stderr(fmt::format("stopped at generation {} by {}; go on with --resume\n", outcome.generation,
                                 outcome.stop_reason));
        return ExitCode::interrupted;
    }
    return print_result(fmt::format("best-of-run: individual {} with {}\nsignature: {}\n", text(outcome.best->id),
                                    reward_text(outcome.best->reward, outcome.reward_unit), outcome.signature),
                        "The run is saved; manifest.json in its directory has the signature.");
}

/// A path as it is, several, or one that looks like a list, as a list in TOML.
std::string setting_text(std::vector<std::string> const& paths) {
    return paths.size() == 1 && !paths[0].starts_with('[') ? paths[0] : toml_strings(paths);
}

/// Reads the command line; an exit code where there is nothing else to do (--help, or a mistake).
std::optional<ExitCode> read_command_line(int argc, char** argv, CommandLine& line) {
    CLI::App app{"Evolves robot controllers (NSGA-II with dynamic behavioral diversity) and archives their lineages."};
    app.name("lore-evolve");
    app.footer(examples);
    app.set_version_flag("--version", [] { return version_text("lore-evolve"); });
    app.add_option("config", line.run.config_path, "the run's configuration, such as jobs/tasks/source.toml");
    app.add_option("--out", line.run.directory, "directory to write into; made if it is not there")->type_name("DIR");
    std::uint64_t seed = 1;
    auto* const seed_option =
        app.add_option("--seed", seed, "of all random numbers (default 1)")->type_name("N")->check(seed_digits);
    take_one_a_time(app.add_option("--set", line.run.overrides, "overrides a setting: section.key=value (repeatable)")
                        ->type_name("KEY=VALUE"));
    app.add_option("--kb", line.run.knowledge_base, "knowledge base that shapes the reward")->type_name("FILE");
    std::vector<std::string> founders;
    app.add_option("--founders", founders,
                   "knowledge base to clone founders from, founders file, or run whose last population they come "
                   "from; several may follow, in equal shares (the same as --set 'founders.from=[\"A\",\"B\"]')")
        ->type_name("FILE|DIR");
    app.add_flag("--resume", line.run.resume, "go on from the directory's checkpoint; without one, start");
    app.add_option("--max-time", line.max_time, "stop at a checkpoint after this time: HH:MM:SS, MM:SS or seconds")
        ->type_name("TIME");
    app.add_option("--archive", line.archive, "keep the ancestors of the last population, or everybody ever evaluated")
        ->check(CLI::IsMember({"lineage", "all"}))
        ->capture_default_str();
    auto* const bench = app.add_flag("--bench", line.bench,
                                     "print the signature of a small fixed run and the steps simulated per second");
    app.add_flag("-q,--quiet", line.run.quiet, "no progress on stderr");
    if (auto const only = parse_command_line(app, argc, argv)) return static_cast<ExitCode>(*only);
    if (line.bench) {
        for (CLI::Option const* const other : app.get_options())
            if (other != bench && other->count() > 0 && other->get_name() != "--quiet")
                throw UsageError(fmt::format("--bench takes no {}", other->get_name()), "it is a run of its own",
                                 "Leave it out.");
        return std::nullopt;
    }
    // --founders takes all that follows, and the configuration may be the last of it.
    if (line.run.config_path.empty() && founders.size() > 1 && founders.back().ends_with(".toml")) {
        line.run.config_path = std::move(founders.back());
        founders.pop_back();
    }
    for (std::string const& path : founders)
        if (!is_printable(path))
            throw UsageError(fmt::format("cannot take --founders {}", path), "the path is no printable UTF-8",
                             "Rename it.");
    if (!founders.empty()) line.run.overrides.push_back("founders.from=" + setting_text(founders));
    if (seed_option->count() > 0) line.run.seed = seed;
    if (line.run.config_path.empty() && line.run.directory.empty())
        throw UsageError("nothing to do", "neither a configuration nor --out DIR is given",
                         "Try 'lore-evolve jobs/tasks/source.toml --out runs/s1', or see 'lore-evolve --help'.");
    if (line.run.directory.empty())
        throw UsageError("no directory to write into", "--out is missing", "Add --out DIR, such as --out runs/s1.");
    if (line.run.config_path.empty() && !line.run.resume)
        throw UsageError("no configuration", "the file's name is missing", "Name one, such as jobs/tasks/source.toml.");
    if (!line.max_time.empty()) line.run.max_seconds = seconds_of(line.max_time);
    line.run.archive_all = line.archive == "all";
    line.run.command_line = fmt::format("{}", fmt::join(argv, argv + argc, " "));
    return std::nullopt;
}

/// Rank 0's part.
ExitCode direct(Session const& session, int argc, char** argv) {
    CommandLine line;
    std::optional<ExitCode> only;
    try {
        active_isa();             // LORE_ISA may be wrong,
        sleeps_while_waiting();   // or LORE_WAITING
        only = read_command_line(argc, argv, line);
    } catch (...) {
        release_other_ranks(session);
        throw;
    }
    if (only) {
        release_other_ranks(session);
        return *only;
    }
    return work(session, line);
}

}   // namespace

int main(int argc, char** argv) {
    own_standard_streams();
    int status = 0;
    try {
        // 1. MPI, if a launcher has started us.
        Session const session{argc, argv};
        try {
            // 2. Rank 0 directs, the others evaluate for it.
            if (session.rank() == 0) status = static_cast<int>(direct(session, argc, argv));
            else work_for_rank_0(session);
        } catch (Error const& error) {
            status = complain(this_program, error.what(), error.exit_code());
            if (session.rank() != 0) session.abort(1);
        } catch (std::bad_alloc const&) {
            complain(this_program, fmt::format("rank {} on {} ran out of memory", session.rank(), host_name()),
                     ExitCode::failure);
            session.abort(1);
        } catch (std::filesystem::filesystem_error const& error) {
            complain(this_program, error);
            session.abort(1);
        } catch (std::exception const& error) {
            // 3. Whatever was not foreseen ends all ranks: one that just left would let the others wait for ever.
            complain(this_program, fmt::format("rank {} on {}: {}", session.rank(), host_name(), error.what()),
                     ExitCode::failure);
            session.abort(1);
        }
        if (std::string const lost = lost_result(); status == 0 && !lost.empty())   // of --help
            status = complain(this_program, lost, ExitCode::failure);
    } catch (Error const& error) { return complain(this_program, error.what(), error.exit_code()); }
    return status;
}
