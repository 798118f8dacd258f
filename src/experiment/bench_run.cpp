#include <lore/experiment/run.h>

#include "work_order.h"

#include <lore/core/standard_streams.h>
#include <lore/core/stopwatch.h>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr std::uint64_t bench_seed = 1;

/// Small, but with everything in it: several distances, growing networks, rewards earned.
ExperimentConfig bench_config() {
    ExperimentConfig config;
    config.evolution.population = 64;
    config.evolution.founders = 128;
    config.evolution.generations = 24;
    config.evolution.distance_schedule.period = 4;
    return config;
}

}   // namespace

BenchOutcome run_bench(Session const& session) {
    ExperimentConfig config = bench_config();
    WorkOrder const order{config, arena_text_of(config), 0, "", ""};
    RunWorld world = open_run_world(config, order.arena_text);
    config.evolution.interface = world.record().interface();
    EvaluationContext context = context_of(order, std::move(world));
    give_order(session, order);
    Farm farm{session.world(), std::move(context)};
    std::uint64_t evaluations = 0;
    Stopwatch const watch;
    auto const count = [&](GenerationReport const& report) {
        evaluations += report.born.size();
        return true;
    };
    try {
        EvolutionState const state =
            evolve(config.evolution, bench_seed, farm.evaluator(), farm.distances(), {}, count);
        double const seconds = watch.total();
        return {state.signature.text(), static_cast<double>(evaluations) * order.config.episode.steps / seconds};
    } catch (Error const& error) {
        if (!farm.broken()) throw;
        write_stderr(fmt::format("lore-evolve: {}\n", error.what()));
        session.abort(static_cast<int>(error.exit_code()));
    }
}

}   // namespace lore
