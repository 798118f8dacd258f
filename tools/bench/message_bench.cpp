// Messages between ranks: what rank 0 spends on one individual that another rank evaluates. `individual` is the time of
// one, `bytes` its length.
#include "evolved_state.h"

#include <lore/archive/messages.h>

#include <benchmark/benchmark.h>

namespace lore {

namespace {

void count(benchmark::State& state, std::size_t individuals, std::size_t bytes) {
    auto const number = static_cast<double>(individuals);
    state.counters["individual"] =
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

}   // namespace
}   // namespace lore
