// Messages between ranks: what rank 0 spends on one individual that another rank evaluates, and what is spent on a pool
// whose distances all ranks measure. `individual` or `pair` is the time of one, `bytes` its length.
#include "evolved_state.h"

#include <lore/archive/messages.h>
#include <lore/behavior/mean_distances.h>

#include <benchmark/benchmark.h>

#include <fmt/format.h>

namespace lore {

namespace {

void count(benchmark::State& state, std::size_t things, std::size_t bytes, char const* thing = "individual") {
    auto const number = static_cast<double>(things);
    state.counters[thing] =
        benchmark::Counter(number, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["bytes"] = static_cast<double>(bytes) / number;
}

/// One by one, as a farm on many ranks sends them.
void genomes_out(benchmark::State& state) {
    auto const& members = evolved_state().state.population.members;
    std::size_t bytes = 0;
    for (auto _ : state) {
        bytes = 0;
        for (Individual const& member : members) {
            Genome const* const genome = &member.birth->genome;
            bytes += pack_genomes(std::span{&genome, 1}).size();
        }
    }
    count(state, members.size(), bytes);
}
BENCHMARK(genomes_out)->Name("message/genome/pack")->Unit(benchmark::kMicrosecond);

void evaluations_in(benchmark::State& state) {
    auto const& members = evolved_state().state.population.members;
    std::vector<Bytes> messages;
    std::size_t bytes = 0;
    for (Individual const& member : members) {
        Delivery const delivery{0, {member.birth->reward, member.birth->shaping, {}, *member.descriptors}};
        messages.push_back(pack_deliveries(std::span{&delivery, 1}));
        bytes += messages.back().size();
    }
    for (auto _ : state)
        for (Bytes const& message : messages) benchmark::DoNotOptimize(unpack_deliveries(message));
    count(state, members.size(), bytes);
}
BENCHMARK(evaluations_in)->Name("message/evaluation/unpack")->Unit(benchmark::kMicrosecond);

void pool_out(benchmark::State& state, DistanceKind kind) {
    auto const pool = evolved_state().descriptors();
    std::size_t bytes = 0;
    for (auto _ : state) bytes = pack_pool(kind, 0, pool).size();
    count(state, pool.size(), bytes);
}
void pool_in(benchmark::State& state, DistanceKind kind) {
    auto const pool = evolved_state().descriptors();
    Bytes const message = pack_pool(kind, 0, pool);
    ComparedPool compared;
    for (auto _ : state) unpack_pool(message, compared);
    count(state, pool.size(), message.size());
}

/// All distances of a pool, and how many they are.
struct Distances {
    explicit Distances(DistanceKind kind) : size(static_cast<int>(evolved_state().pool.size())), matrix(size) {
        measure_rows(kind, evolved_state().descriptors(), 0, size, matrix);
    }
    std::size_t pairs() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size - 1) / 2; }

    int size;
    DistanceMatrix matrix;
};
void distances_out(benchmark::State& state, DistanceKind kind) {
    Distances const distances{kind};
    std::size_t bytes = 0;
    for (auto _ : state) bytes = pack_distances(distances.matrix.rows(0, distances.size)).size();
    count(state, distances.pairs(), bytes, "pair");
}
void distances_in(benchmark::State& state, DistanceKind kind) {
    Distances distances{kind};
    Bytes const message = pack_distances(distances.matrix.rows(0, distances.size));
    for (auto _ : state) unpack_distances(message, distances.matrix.rows(0, distances.size));
    count(state, distances.pairs(), message.size(), "pair");
}

struct Case {
    char const* name;
    void (*run)(benchmark::State&, DistanceKind);
    bool of_rows = false;
};
bool const registered = [] {
    for (Case const& one : {Case{"pool/pack", pool_out}, Case{"pool/unpack", pool_in},
                            Case{"distances/pack", distances_out, true}, Case{"distances/unpack", distances_in, true}})
        for (DistanceKind const kind :
             {DistanceKind::adhoc, DistanceKind::hamming, DistanceKind::trajectory, DistanceKind::entropy}) {
            if (one.of_rows && is_euclidean(kind)) continue;   // of these only means are sent
            benchmark::RegisterBenchmark(fmt::format("message/{}/{}", one.name, name(kind)).c_str(), one.run, kind)
                ->Unit(benchmark::kMicrosecond);
        }
    return true;
}();

}   // namespace
}   // namespace lore
