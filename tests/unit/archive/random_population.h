#pragma once

#include "support/robot.h"
#include "support/toy_world.h"

#include <lore/archive/world_record.h>
#include <lore/collectball/collectball.h>
#include <lore/evolution/evolution.h>

namespace lore {

/// Evaluates nothing: what an individual shows is a function of its genes. Evolution with it is quick and real.
/// Robots of collectball get whole rewards, others fractions of both signs.
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
        bool const is_robot = genome.interface == test::robot;
        evaluation.reward = is_robot ? static_cast<int>(sum / 4.0f) : static_cast<double>(sum / 4.0f) - 4.75;
        evaluation.shaping = genome.biases[0];
        auto const bias = [&](std::size_t i) { return genome.biases[i % genome.biases.size()]; };
        Descriptors& descriptors = evaluation.descriptors;
        descriptors.outcome = {bias(1), bias(2), sum, 1};
        int const channels = genome.interface.first_hidden(), words = (channels + 15) / 16;
        for (int step = 0; step < steps; ++step) {
            auto const at = static_cast<std::size_t>(step);
            auto const gene = static_cast<std::uint32_t>(
                (genome.edges.empty() ? bias(at) : genome.edges[at % genome.edges.size()].weight) * 4096);
            for (int word = 0; word < words; ++word) {
                std::uint32_t const mask = (1u << std::min(16, channels - 16 * word)) - 1;
                descriptors.channel_bits.push_back(
                    static_cast<std::uint16_t>((gene + static_cast<std::uint32_t>(step + word)) & mask));
            }
            if (step % steps_per_tile_sample == 0)
                descriptors.path.push_back({static_cast<std::uint8_t>(gene % 12), static_cast<std::uint8_t>(gene % 8)});
        }
        descriptors.entropies.assign(static_cast<std::size_t>(channels), genome.biases[0]);
        return evaluation;
    }

private:
    int steps_;
};

namespace test {

inline WorldRecord robots_world() {
    return world_record(CollectballWorld{load_arena("collectball", "source")}.facts());
}

/// A world of foreign code with more than 16 channels, binary and continuous ones in turn, two of them effectors.
inline WorldRecord toys_world() {
    ToyWorldConfig config;
    for (int i = 0; i < 17; ++i) config.sensors.push_back(i % 2 == 0);
    config.effectors = {false, true};
    config.outcome_size = 4;
    return world_record(ToyWorld{config}.facts(), {"worlds/toy.so", 0x0123456789abcdefu, 1000, "length = 2\n"});
}

}   // namespace test

inline EvolutionConfig small_evolution(int generations, Interface interface = test::robot) {
    EvolutionConfig config;
    config.interface = interface;
    config.population = 20;
    config.founders = 40;
    config.generations = generations;
    config.distance_schedule.period = 5;
    config.use_shaping = true;
    return config;
}

inline EvolutionState evolved(int generations, std::uint64_t seed = 1, Interface interface = test::robot) {
    PretendedEvaluator evaluator;
    return evolve(small_evolution(generations, interface), seed, evaluator, {},
                  [](GenerationReport const&) { return true; });
}

}   // namespace lore
