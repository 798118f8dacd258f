// Episodes: the plain definition, and the lanes with everything an evaluation records, per instruction set and size of
// the networks. `step` is the time of one step of one robot.
#include "evolved_state.h"

#include <lore/core/isa.h>
#include <lore/episode/episode.h>
#include <lore/network/mutation.h>

#include <benchmark/benchmark.h>

#include <string>

namespace lore {

namespace {

/// As many genomes as one generation has children, each with at least `edges` connections: evolved ones that grew.
/// Random additions change what the robots do, so figures of different sizes are not of the same behavior.
std::vector<Genome> grown(int edges, int hidden) {
    std::vector<Genome> genomes;
    for (Individual const& member : evolved_state().state.population.members) {
        Genome genome = member.birth->genome;
        Stream rng{1, Purpose::test, 0, static_cast<std::uint32_t>(genomes.size())};
        while (genome.hidden_count() < hidden && split_edge(genome, {}, rng)) {}
        while (static_cast<int>(genome.edges.size()) < edges && add_edge(genome, {}, rng)) {}
        genomes.push_back(std::move(genome));
    }
    return genomes;
}

void count_steps(benchmark::State& state, std::size_t episodes) {
    double const steps = static_cast<double>(episodes) * evolved_state().context.episode.steps;
    // The inverse of a rate is shown as the time of one.
    state.counters["step"] =
        benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void batch_in_lanes(benchmark::State& state, Isa isa, int edges, int hidden, std::size_t size) {
    std::vector<Genome> const genomes = grown(edges, hidden);
    std::vector<Genome const*> pointers;
    for (Genome const& genome : genomes) pointers.push_back(&genome);
    pointers.resize(size);
    Isa const before = active_isa();
    use_isa(isa);
    for (auto _ : state) benchmark::DoNotOptimize(evaluate_batch(evolved_state().context, pointers));
    use_isa(before);
    count_steps(state, size);
}

void plain_episode(benchmark::State& state, int edges, int hidden) {
    std::vector<Genome> const genomes = grown(edges, hidden);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(evaluate_plainly(evolved_state().context, genomes[i++ % genomes.size()]));
    count_steps(state, 1);
}

bool const registered = [] {
    struct Size {
        char const* name;
        int edges, hidden;
    };
    // The last as of long runs: hidden neurons with few connections, in other places in every robot.
    for (Size size :
         {Size{"40_connections", 40, 2}, Size{"200_connections", 200, 10}, Size{"8_hidden_neurons", 44, 8}}) {
        std::string const name_of_size = size.name;
        benchmark::RegisterBenchmark(("episode/plain/" + name_of_size).c_str(), plain_episode, size.edges, size.hidden)
            ->Unit(benchmark::kMillisecond);
        for (int isa = 0; isa <= static_cast<int>(detected_isa()); ++isa)
            benchmark::RegisterBenchmark(
                ("episode/batch_of_200/" + name_of_size + "/" + std::string{name(static_cast<Isa>(isa))}).c_str(),
                batch_in_lanes, static_cast<Isa>(isa), size.edges, size.hidden, std::size_t{200})
                ->Unit(benchmark::kMillisecond);
    }
    // What is left of the lanes' gain where a rank has fewer individuals than lanes.
    for (std::size_t batch : {1, 4, 8, 12, 16, 24, 32, 48, 64, 100})
        benchmark::RegisterBenchmark(("episode/batch_of_" + std::to_string(batch) + "/40_connections").c_str(),
                                     batch_in_lanes, detected_isa(), 40, 2, batch)
            ->Unit(benchmark::kMillisecond);
    return true;
}();

}   // namespace
}   // namespace lore
