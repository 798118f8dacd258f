// NSGA-II: sorting, crowding and the cut of a joint pool of 400 by three objectives; a whole generation of 200,
// everything included, of the source task and of the target task with a knowledge base of about 24 000 features.
#include "evolved_state.h"

#include <lore/evolution/pareto.h>
#include <lore/evolution/selection.h>

#include <benchmark/benchmark.h>

#include <string>

namespace lore {

namespace {

/// Reward and diversity as evolved; every sixth value of a knowledge base as a third objective.
std::vector<Objectives> three_objectives() {
    std::vector<Objectives> points;
    for (Individual const& member : evolved_state().pool) {
        Objectives objectives = member.objectives;
        objectives.value[2] = static_cast<double>(member.id().slot % 6);
        objectives.count = 3;
        points.push_back(objectives);
    }
    return points;
}

void fronts(benchmark::State& state) {
    std::vector<Objectives> const points = three_objectives();
    for (auto _ : state) benchmark::DoNotOptimize(non_dominated_fronts(points));
}
BENCHMARK(fronts)->Name("evolution/fronts_400x3")->Unit(benchmark::kMicrosecond);

void fronts_by_definition(benchmark::State& state) {
    std::vector<Objectives> const points = three_objectives();
    for (auto _ : state) benchmark::DoNotOptimize(non_dominated_fronts_plainly(points));
}
BENCHMARK(fronts_by_definition)->Name("evolution/fronts_400x3_by_definition")->Unit(benchmark::kMicrosecond);

void ranking(benchmark::State& state) {
    std::vector<Objectives> const points = three_objectives();
    std::vector<Individual> const& pool = evolved_state().pool;
    int generation = 0;
    for (auto _ : state) {
        ++generation;
        std::vector<std::uint64_t> keys;
        for (Individual const& member : pool) keys.push_back(tie_key(TieRule::random, 1, generation, member.id()));
        benchmark::DoNotOptimize(rank(points, keys, 200));
    }
}
BENCHMARK(ranking)->Name("evolution/ranking_400x3")->Unit(benchmark::kMicrosecond);

void whole_generation(benchmark::State& state, EvolvedState const& (*population)(), DistanceKind kind) {
    EvolvedState const& evolved = population();
    EvolutionConfig config = evolved.config;
    config.generations += 1000000;
    config.distance_schedule.distances = {kind};
    SerialEvaluator evaluator{evolved.context};
    EvolutionState now = evolved.state;
    auto const one = [](GenerationReport const&) { return false; };
    now = evolve(config, 1, evaluator, std::move(now), one);   // the change of distance is measured apart
    for (auto _ : state) now = evolve(config, 1, evaluator, std::move(now), one);
}

bool const registered = [] {
    for (int k = 0; k < distance_kinds; ++k) {
        auto const kind = static_cast<DistanceKind>(k);
        std::string const kind_name{name(kind)};
        benchmark::RegisterBenchmark(("evolution/generation/source/" + kind_name).c_str(), whole_generation,
                                     evolved_state, kind)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("evolution/generation/target/" + kind_name).c_str(), whole_generation,
                                     evolved_with_knowledge, kind)
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}   // namespace
}   // namespace lore
