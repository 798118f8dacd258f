// Behavioral distances: what one generation has to measure, that is, all pairs of 400 with at least one of 200
// children; by a Euclidean kind, whose distances are not kept, all pairs.
#include "evolved_state.h"

#include <lore/behavior/distance_matrix.h>
#include <lore/behavior/mean_distances.h>
#include <lore/core/isa.h>

#include <benchmark/benchmark.h>

#include <string>

namespace lore {

namespace {

void distances_of_a_generation(benchmark::State& state, DistanceKind kind, Isa isa) {
    std::vector<Descriptors const*> const pool = evolved_state().descriptors();
    int const size = static_cast<int>(pool.size()), known = is_euclidean(kind) ? 0 : size / 2;
    DistanceMatrix matrix(size);
    Isa const before = active_isa();
    use_isa(isa);
    for (auto _ : state) {
        if (!is_euclidean(kind)) measure_rows(kind, pool, known, size, matrix);
        benchmark::DoNotOptimize(is_euclidean(kind) ? mean_distances(kind, pool) : matrix.means());
    }
    use_isa(before);
    state.counters["pairs"] = benchmark::Counter((size * (size - 1) - known * (known - 1)) / 2.0,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void one_distance_by_definition(benchmark::State& state, DistanceKind kind) {
    std::vector<Descriptors const*> const pool = evolved_state().descriptors();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(distance(kind, *pool[i % pool.size()], *pool[(i * 7 + 1) % pool.size()]));
        ++i;
    }
}

bool const registered = [] {
    for (int k = 0; k < distance_kinds; ++k) {
        auto const kind = static_cast<DistanceKind>(k);
        std::string const kind_name{name(kind)};
        benchmark::RegisterBenchmark(("distance/definition/" + kind_name).c_str(), one_distance_by_definition, kind);
        for (int isa = 0; isa <= static_cast<int>(detected_isa()); ++isa)
            benchmark::RegisterBenchmark(
                ("distance/generation/" + kind_name + "/" + std::string{name(static_cast<Isa>(isa))}).c_str(),
                distances_of_a_generation, kind, static_cast<Isa>(isa))
                ->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}   // namespace
}   // namespace lore
