// Worlds beside collectball: what the interface of libraries costs, and the maze in its lanes, in batches of lives and
// alone. `step` is the time of one step of one life.
#include "evolved_state.h"

#include <lore/core/isa.h>
#include <lore/maze/maze.h>
#include <lore/world/library.h>

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace lore {

namespace {

constexpr EpisodeConfig steps_of_a_maze{400};

/// A world without the lanes that it has.
class WithoutLanes final : public World {
public:
    explicit WithoutLanes(std::shared_ptr<World const> world) : world_(std::move(world)) {}
    WorldFacts const& facts() const override { return world_->facts(); }
    std::unique_ptr<Life> begin() const override { return world_->begin(); }

private:
    std::shared_ptr<World const> world_;
};

EvolvedState const& evolved_in_a_maze() {
    static EvolvedState const evolved =
        evolve_for(50, 1, {std::make_shared<MazeWorld>(maze_plan("hard")), steps_of_a_maze, std::nullopt});
    return evolved;
}

void count_steps(benchmark::State& state, double steps) {
    // The inverse of a rate is shown as the time of one.
    state.counters["step"] =
        benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// All evaluations of a generation, with everything that they record.
void maze(benchmark::State& state, Isa isa, bool in_lanes) {
    EvaluationContext context = evolved_in_a_maze().context;
    if (!in_lanes) context.world = std::make_shared<WithoutLanes>(context.world);
    std::vector<Genome const*> genomes;
    for (Individual const& member : evolved_in_a_maze().state.population.members)
        genomes.push_back(&member.birth->genome);
    double steps = 0;
    for (Genome const* genome : genomes)
        steps += record_episode(*context.world, compile(*genome), context.episode).steps();
    Isa const before = active_isa();
    use_isa(isa);
    for (auto _ : state) benchmark::DoNotOptimize(evaluate_batch(context, genomes));
    use_isa(before);
    count_steps(state, steps);
}

void library_that_does_nothing(benchmark::State& state) {
    constexpr int lives = 16;
    auto const world = load_world(LORE_BENCH_NOTHING, "");
    auto const batch = world->begin_lives(lives);
    std::vector<float> sensors(3 * lives), x(lives), y(lives), effectors(lives, 0.5f), rewards(lives);
    std::vector<unsigned char> over(lives);
    for (auto _ : state) {
        batch->sense(sensors, x, y);
        batch->act(effectors, rewards, over);
        benchmark::DoNotOptimize(rewards.data());
    }
    count_steps(state, lives);
}

bool const registered = [] {
    benchmark::RegisterBenchmark("world/library_that_does_nothing/batch_of_16", library_that_does_nothing);
    for (int isa = 0; isa <= static_cast<int>(detected_isa()); ++isa)
        for (bool const in_lanes : {true, false})
            benchmark::RegisterBenchmark((std::string{"world/maze/"} + (in_lanes ? "lanes/" : "batches/") +
                                          std::string{name(static_cast<Isa>(isa))})
                                             .c_str(),
                                         maze, static_cast<Isa>(isa), in_lanes)
                ->Unit(benchmark::kMillisecond);
    return true;
}();

}   // namespace
}   // namespace lore
