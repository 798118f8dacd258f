#include <lore/experiment/run.h>

#include "run_books.h"
#include "run_cost.h"
#include "run_setup.h"
#include "stop_request.h"
#include "time_report.h"
#include "work_order.h"

#include <lore/archive/genome_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/core/progress.h>
#include <lore/core/standard_streams.h>
#include <lore/core/stopwatch.h>
#include <lore/experiment/run_directory.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <utility>

namespace lore {

namespace {

constexpr int generations_a_line = 100;   ///< of progress, where stderr is no terminal

std::string describe(GenerationSummary const& row, std::string_view unit, bool shaped) {
    std::string note = fmt::format("best {}, mean {:.2f}, {}", reward_text(row.best_reward, unit), row.mean_reward,
                                   name(row.distance));
    if (shaped) note += fmt::format(", shaping {:.2f}", row.best_shaping);
    return note;
}

/// The error of an evaluation that threw: names the individual, whose genome it saves.
Error tell(EvaluationFailure const& failure, int generation, WorldRecord const& world, std::string const& genome_path) {
    IndividualId const id{static_cast<std::uint32_t>(generation), static_cast<std::uint32_t>(failure.index())};
    std::string remedy;
    try {
        write_genome(genome_path, {id, failure.genome(), failure.rank(), failure.reason(), world});
        remedy = fmt::format("Its genome is in {}; 'lore-replay {} --individual failed' repeats the evaluation. Resume "
                             "the run when the cause is mended.",
                             genome_path, std::filesystem::path{genome_path}.parent_path().string());
    } catch (Error const& error) { remedy = fmt::format("Its genome could not be saved: {}", error.what()); }
    return Error(fmt::format("the evaluation of individual {} failed on rank {} in generation {}", text(id),
                             failure.rank(), generation),
                 failure.reason(), remedy);
}

/// The exception that is being handled, as an Error.
Error failure_in_hand(int generation, WorldRecord const& world, std::string const& genome_path) {
    auto const of_rank_0 = [&](std::string const& reason, std::string_view remedy) {
        return Error(fmt::format("rank 0 on {} failed in generation {}", host_name(), generation), reason, remedy);
    };
    try {
        throw;
    } catch (EvaluationFailure const& failure) {
        return tell(failure, generation, world, genome_path);
    } catch (Error const& error) { return error; } catch (std::bad_alloc const&) {
        return of_rank_0("out of memory", "Resume the run where there is more.");
    } catch (std::exception const& error) { return of_rank_0(error.what(), "Resume the run."); }
}

/// Ends all ranks; the only way once replies are under way that no rank will take.
[[noreturn]] void end_all(Session const& session, Error const& error) {
    write_stderr(fmt::format("lore-evolve: {}\n", error.what()));
    session.abort(static_cast<int>(error.exit_code()));
}

/// What rule share needs on rank 0.
std::vector<double> values_for_the_pool(EvaluationContext const& context) {
    if (!context.shaper || context.shaper->rule() != ShapingRule::share) return {};
    std::span<double const> const values = context.shaper->base().values();
    return {values.begin(), values.end()};
}

/// What shows that nobody matches a feature. The other rules have no such value.
double value_of_nothing(EvaluationContext const& context) {
    bool const by_max = context.shaper && context.shaper->rule() == ShapingRule::max;
    return by_max ? context.shaper->nothing_shown() : no_feature_value;
}

/// A checkpoint's features become places in a table.
void refuse_unknown_features(PreparedRun const& run) {
    if (!run.setup.checkpoint) return;
    std::size_t const known = values_for_the_pool(run.context).size();
    for (Individual const& member : run.setup.checkpoint->state.population.members)
        if (member.shown && !member.shown->empty() && member.shown->back() >= known)
            throw Error(fmt::format("cannot go on from {}", run.setup.file(run_file::checkpoint)),
                        fmt::format("feature {} is not in the knowledge base", member.shown->back()),
                        "Take a copy that is whole, or start in another directory.");
}

/// Prepares while the other ranks wait: whatever goes wrong, they are released.
PreparedRun prepare_or_release(Session const& session, RunOptions const& options) {
    try {
        PreparedRun run = prepare_run(options);
        refuse_unknown_features(run);
        return run;
    } catch (...) {
        release_other_ranks(session);
        throw;
    }
}

/// A finished run has nothing to do but to write its lineage again where that is lost or damaged.
void mend_lineage(RunSetup const& setup) {
    std::string const path = setup.file(run_file::lineage);
    FileRecord const* const listed = find_path(setup.manifest.outputs, run_file::lineage);
    bool const whole = std::filesystem::exists(path) &&
                       (listed == nullptr || record_of(listed->role, path, listed->path).checksum == listed->checksum);
    if (!whole) write_lineage(path, setup.checkpoint->state.population, setup.manifest.world, setup.founders_origin());
}

RunOutcome outcome(EvolutionState const& state, std::string const& stop_reason, std::string const& reward_unit) {
    return {stop_reason.empty(),
            stop_reason,
            state.signature.text(),
            state.population.generation,
            best_of_run(state.population).birth,
            reward_unit};
}

/// What happens after a generation: it is entered into the books and shown, and the run stops or goes on.
class Supervisor {
public:
    /// `generation` is the last that is complete, or -1.
    Supervisor(RunBooks& books, EvolutionConfig const& evolution, RunOptions const& options, Stopwatch const& watch,
               int generation, int ranks)
        : books_(books), evolution_(evolution), options_(options), watch_(watch), generation_(generation),
          forecast_(generation, evolution.generations, ranks, watch.total()),
          progress_(options.directory, evolution.generations, "generations", generations_a_line, options.quiet) {
        progress_.start_at(std::max(generation, 0));
    }

    /// Whether to go on.
    bool after_generation(GenerationReport const& report) {
        generation_ = report.generation;
        selection_seconds_ += report.selection_seconds;
        GenerationSummary const& row = books_.add(report);
        if (std::string const line = forecast_.after(generation_, watch_.total()); !line.empty()) progress_.tell(line);
        progress_.update(generation_, describe(row, books_.reward_unit(), evolution_.use_shaping));
        if (generation_ == evolution_.generations) return true;
        stop_reason_ = stop_request();
        if (stop_reason_.empty() && options_.max_seconds && watch_.total() >= *options_.max_seconds)
            stop_reason_ = "time limit";
        if (!stop_reason_.empty()) return false;
        if (books_.checkpoint_is_due()) books_.write_checkpoint(*report.state);
        return true;
    }

    int generation() const { return generation_; }
    std::string const& stop_reason() const { return stop_reason_; }   ///< empty where nothing stopped the run
    double selection_seconds() const { return selection_seconds_; }

private:
    RunBooks& books_;
    EvolutionConfig const& evolution_;
    RunOptions const& options_;
    Stopwatch const& watch_;
    int generation_;
    std::string stop_reason_;
    double selection_seconds_ = 0;
    CostForecast forecast_;
    Progress progress_;
};

}   // namespace

RunOutcome run_experiment(Session const& session, RunOptions const& options) {
    Stopwatch const watch;
    install_stop_handlers();
    PreparedRun run = prepare_or_release(session, options);
    EvolutionState state = run.setup.checkpoint ? run.setup.checkpoint->state : EvolutionState{};
    if (run.setup.already_done) {
        release_other_ranks(session);
        mend_lineage(run.setup);
        return outcome(state, "", run.setup.manifest.world.reward_unit);
    }
    if (!run.setup.warning.empty()) write_stderr(fmt::format("warning: {}\n", run.setup.warning));

    std::vector<double> feature_values = values_for_the_pool(run.context);
    double const nothing_shown = value_of_nothing(run.context);
    std::vector<std::string> hosts = give_order(session, run.setup.order);
    // Releases the others whatever happens from here on.
    Farm farm{session.world(), std::move(run.context)};
    EvolutionConfig evolution = run.setup.order.config.evolution;
    evolution.interface = run.setup.manifest.world.interface();
    evolution.feature_values = std::move(feature_values);
    std::uint64_t const seed = run.setup.seed;
    std::vector<Genome> const founders = std::move(run.setup.founders);
    std::string const genome_path = run.setup.file(run_file::failed_genome);
    WorldRecord const world = run.setup.manifest.world;
    double const start_seconds = watch.total();
    RunBooks books{std::move(run.setup), std::move(hosts), options.command_line, nothing_shown};
    int const reached = state.population.members.empty() ? -1 : state.population.generation;
    Supervisor supervisor{books, evolution, options, watch, reached, session.size()};
    try {
        auto const observe = [&](GenerationReport const& report) { return supervisor.after_generation(report); };
        state = evolve(evolution, seed, farm.evaluator(), farm.distances(), std::move(state), observe, founders);
    } catch (std::exception const&) {
        Error const told = failure_in_hand(supervisor.generation() + 1, world, genome_path);
        if (farm.broken()) end_all(session, told);
        throw told;
    }

    std::vector<RankTimes> const rank_times = farm.stop();
    std::string const& stop_reason = supervisor.stop_reason();
    books.close(state, stop_reason.empty() ? RunStatus::done : RunStatus::interrupted,
                stop_reason.empty() ? "done" : stop_reason);
    if (!options.quiet)
        write_stderr(time_report(rank_times, {start_seconds, supervisor.selection_seconds(), books.filing_seconds(),
                                              watch.total()}) +
                     cost_report(rank_times, books.session_steps(), books.session_seconds()));
    return outcome(state, stop_reason, books.reward_unit());
}

}   // namespace lore
