#pragma once

#include <lore/behavior/distance_measurer.h>
#include <lore/core/random.h>
#include <lore/evaluation/evaluator.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <vector>

namespace lore {

/// Judges a genome by its genes alone, in no time: reward for some high biases, behavior from the weights. Works
/// through the batch in whatever order it is told to, as ranks would; unless that is the order of the request, it
/// notifies of all but the last quarter. Measures, too, in rows whose order depends on that order.
class SyntheticEvaluator : public Evaluator, public DistanceMeasurer {
public:
    enum class Order { forward, backward, shuffled };
    explicit SyntheticEvaluator(Order order = Order::forward) : order_(order) {}

    std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes,
                                     CompletionListener* listener = nullptr) override {
        std::vector<std::size_t> order(genomes.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        if (order_ == Order::backward) std::reverse(order.begin(), order.end());
        if (order_ == Order::shuffled) rng_.shuffle(std::span{order});
        std::vector<Evaluation> evaluations(genomes.size());
        std::size_t done = 0;
        for (std::size_t const k : order) {
            evaluations[k] = judge(*genomes[k]);
            if (listener == nullptr || order_ == Order::forward || ++done > genomes.size() * 3 / 4) continue;
            listener->completed(static_cast<int>(k), evaluations[k]);
            if (done % 25 == 0) listener->idle();
        }
        evaluated_ += static_cast<int>(genomes.size());
        return evaluations;
    }

    void measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                 DistanceMatrix& matrix) override {
        int const size = static_cast<int>(pool.size());
        measured_from_.push_back(known);
        int const middle = known + (size - known) / 3;
        if (order_ == Order::forward) return measure_rows(kind, pool, known, size, matrix);
        measure_rows(kind, pool, middle, size, matrix);
        measure_rows(kind, pool, known, middle, matrix);
    }

    std::vector<double> means(DistanceKind kind, std::span<Descriptors const* const> pool) override {
        return mean_distances(kind, pool);
    }

    int evaluated() const { return evaluated_; }
    std::vector<int> const& measured_from() const { return measured_from_; }

private:
    static Evaluation judge(Genome const& genome) {
        Evaluation e;
        for (float const bias : genome.biases) e.reward += bias > 0.8f;
        float const first = genome.edges.empty() ? 0.0f : genome.edges[0].weight;
        float const last = genome.edges.empty() ? 0.0f : genome.edges.back().weight;
        e.shaping = std::floor(first * 8) / 8;
        e.descriptors.outcome = {first, last};
        for (Edge const& edge : genome.edges) {
            e.descriptors.channel_bits.push_back(
                static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(edge.weight) >> 8 & 0x7fff));
            e.descriptors.path.push_back(
                {static_cast<std::uint8_t>(edge.weight * 11), static_cast<std::uint8_t>(edge.source % 8)});
        }
        e.descriptors.entropies.resize(15);
        e.descriptors.entropies[0] = first;
        e.descriptors.entropies[14] = last;
        return e;
    }

    Order order_;
    Stream rng_{1, Purpose::test};
    int evaluated_ = 0;
    std::vector<int> measured_from_;
};

/// All individuals are alike.
class ConstantEvaluator : public Evaluator {
public:
    std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes, CompletionListener* = nullptr) override {
        Evaluation e;
        e.descriptors.outcome = {0, 0};
        e.descriptors.entropies.resize(15);
        return std::vector<Evaluation>(genomes.size(), e);
    }
};

}   // namespace lore
