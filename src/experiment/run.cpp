#include <lore/experiment/run.h>

#include "run_books.h"
#include "run_setup.h"
#include "time_report.h"
#include "work_order.h"

#include <lore/archive/genome_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/core/progress.h>
#include <lore/core/stopwatch.h>
#include <lore/experiment/run_directory.h>
#include <lore/experiment/stop_request.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <utility>

namespace lore {

namespace {

constexpr int generations_a_line = 100;   ///< of progress, where stderr is no terminal

std::string describe(ProgressRow const& row, bool shaped) {
    std::string note =
        fmt::format("best {} balls, mean {:.2f}, {}", row.best_balls, row.mean_balls, name(row.distance));
    if (shaped) note += fmt::format(", shaping {:.2f}", row.best_shaping);
    return note;
}

/// The rest of the story of an evaluation that threw: saves the genome, and says who it was.
Error tell(EvaluationFailure const& failure, int generation, std::string const& genome_path) {
    IndividualId const id{static_cast<std::uint32_t>(generation), static_cast<std::uint32_t>(failure.index())};
    std::string remedy;
    try {
        write_genome(genome_path, {id, failure.genome(), failure.rank(), failure.reason()});
        remedy = fmt::format("Its genome is in {}; resume the run when the cause is mended.", genome_path);
    } catch (Error const& error) { remedy = fmt::format("Its genome could not be saved: {}", error.what()); }
    return Error(fmt::format("the evaluation of individual {} failed on rank {} in generation {}", text(id),
                             failure.rank(), generation),
                 failure.reason(), remedy);
}

/// Ends all ranks; the only way once replies are under way that nobody will take.
[[noreturn]] void end_all(Session const& session, Error const& error) {
    fmt::print(stderr, "lore-evolve: {}\n", error.what());
    session.abort(static_cast<int>(error.exit_code()));
}

/// Prepares while the other ranks wait: whatever goes wrong, they are released.
PreparedRun prepare_or_release(Session const& session, RunOptions const& options) {
    try {
        return prepare_run(options);
    } catch (...) {
        release_other_ranks(session);
        throw;
    }
}

/// A finished run has nothing to do but to write its lineage again where that is lost or damaged.
void mend_lineage(RunSetup const& setup) {
    std::string const path = setup.file(run_file::lineage);
    auto const& outputs = setup.manifest.outputs;
    auto const listed = std::find_if(outputs.begin(), outputs.end(),
                                     [](FileRecord const& output) { return output.path == run_file::lineage; });
    bool const whole =
        std::filesystem::exists(path) &&
        (listed == outputs.end() || record_of("output", path, listed->path).checksum == listed->checksum);
    if (!whole) write_lineage(path, setup.checkpoint->state.population);
}

}   // namespace

RunOutcome run_experiment(Session const& session, RunOptions const& options) {
    Stopwatch const watch;
    install_stop_handlers();
    PreparedRun run = prepare_or_release(session, options);
    RunSetup& setup = run.setup;
    EvolutionState state = setup.checkpoint ? setup.checkpoint->state : EvolutionState{};
    if (setup.already_done) {
        release_other_ranks(session);
        mend_lineage(setup);
        return {true, "", state.signature.text(), state.population.generation, best_of_run(state.population).birth};
    }
    if (!setup.warning.empty()) fmt::print(stderr, "warning: {}\n", setup.warning);

    std::vector<std::string> hosts = give_order(session, setup.order);
    Farm farm{session.world(),
              evaluation_in(std::move(run.context))};   // releases the others whatever happens from here on
    EvolutionConfig const evolution = setup.order.config.evolution;
    std::uint64_t const seed = setup.seed;
    std::string const genome_path = setup.file(run_file::failed_genome);
    RunBooks books{std::move(setup), std::move(hosts), options.command_line};

    int generation = state.population.members.empty() ? -1 : state.population.generation;   // the last that is complete
    Progress progress{options.directory, evolution.generations, "generations", generations_a_line, options.quiet};
    progress.start_at(std::max(generation, 0));
    MasterTimes times;
    std::string stop_reason;
    auto const observe = [&](GenerationReport const& report) {
        generation = report.generation;
        times.selection += report.selection_seconds;
        progress.update(generation, describe(books.add(report), evolution.use_shaping));
        if (generation == evolution.generations) return true;
        stop_reason = stop_request();
        if (stop_reason.empty() && options.max_seconds && watch.total() >= *options.max_seconds)
            stop_reason = "time limit";
        if (!stop_reason.empty()) return false;
        if (books.checkpoint_is_due()) books.write_checkpoint(*report.state);
        return true;
    };
    try {
        state = evolve(evolution, seed, farm, std::move(state), observe);
    } catch (EvaluationFailure const& failure) {
        Error const told = tell(failure, generation + 1, genome_path);
        if (farm.broken()) end_all(session, told);
        throw told;
    } catch (Error const& error) {
        if (farm.broken()) end_all(session, error);
        throw;
    } catch (std::exception const& error) {
        bool const memory = dynamic_cast<std::bad_alloc const*>(&error) != nullptr;
        Error const told(fmt::format("rank 0 on {} failed in generation {}", host_name(), generation + 1),
                         memory ? "out of memory" : error.what(),
                         memory ? "Resume the run where there is more." : "Resume the run.");
        if (farm.broken()) end_all(session, told);
        throw told;
    }

    std::vector<RankTimes> const rank_times = farm.stop();
    books.close(state, stop_reason.empty() ? RunStatus::done : RunStatus::interrupted,
                stop_reason.empty() ? "done" : stop_reason);
    times.files = books.filing_seconds();
    times.wall = watch.total();
    if (!options.quiet) fmt::print(stderr, "{}", time_report(rank_times, times));
    return {stop_reason.empty(), stop_reason, state.signature.text(), state.population.generation,
            best_of_run(state.population).birth};
}

}   // namespace lore
