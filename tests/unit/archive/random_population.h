#pragma once

#include <lore/evolution/evolution.h>

namespace lore {

/// Evaluates nothing: what an individual shows is a function of its genes. Evolution with it is quick and real.
class PretendedEvaluator : public Evaluator {
public:
    explicit PretendedEvaluator(int steps = 100) : steps_(steps) {}

    std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes, CompletionListener* = nullptr) override {
        std::vector<Evaluation> evaluations;
        for (Genome const* genome : genomes) evaluations.push_back(pretend(*genome, steps_));
        return evaluations;
    }

    static Evaluation pretend(Genome const& genome, int steps) {
        Evaluation evaluation;
        float sum = 0;
        for (Edge const& edge : genome.edges) sum += edge.weight;
        evaluation.balls = static_cast<int>(sum / 4.0f);
        evaluation.shaping = genome.biases[0];
        Descriptors& descriptors = evaluation.descriptors;
        descriptors.ball_positions = {{genome.biases[1], genome.biases[2]}, {sum, 1}};
        for (int step = 0; step < steps; ++step) {
            auto const gene = static_cast<std::uint32_t>(
                genome.edges[static_cast<std::size_t>(step) % genome.edges.size()].weight * 4096);
            descriptors.channel_bits.push_back(
                static_cast<std::uint16_t>((gene + static_cast<std::uint32_t>(step)) & 0x7fff));
            if (step % steps_per_tile_sample == 0)
                descriptors.path.push_back({static_cast<std::uint8_t>(gene % 12), static_cast<std::uint8_t>(gene % 8)});
        }
        descriptors.entropies.fill(genome.biases[0]);
        return evaluation;
    }

private:
    int steps_;
};

inline EvolutionConfig small_evolution(int generations) {
    EvolutionConfig config;
    config.population = 20;
    config.founders = 40;
    config.generations = generations;
    config.distance_schedule.period = 5;
    config.use_shaping = true;
    return config;
}

inline EvolutionState evolved(int generations, std::uint64_t seed = 1) {
    PretendedEvaluator evaluator;
    return evolve(small_evolution(generations), seed, evaluator, {}, [](GenerationReport const&) { return true; });
}

}   // namespace lore
