#pragma once

#include <lore/core/random.h>
#include <lore/network/mutation.h>
#include <lore/world/channels.h>
#include <lore/world/world.h>

#include <cmath>

namespace lore::test {

/// A world of any channels, for tests: what a life senses is a mixture of what it did, rewards are fractions of both
/// signs, and lives end at steps that depend on what they do.
struct ToyWorldConfig {
    std::vector<bool> sensors{false, true};   ///< whether each is binary
    std::vector<bool> effectors{false};       ///< likewise
    int outcome_size = 1;
    int max_batch = most_lives;
    float end_above = 1e9f;   ///< a life is over once the sum of its first effector's values is above
};

class ToyWorld final : public World {
public:
    explicit ToyWorld(ToyWorldConfig config = {}) : config_(std::move(config)) {
        facts_.name = "toy";
        facts_.task = "test";
        facts_.reward_unit = "points";
        for (std::size_t i = 0; i < config_.sensors.size(); ++i)
            facts_.sensors.push_back({"sensor_" + std::to_string(i), config_.sensors[i]});
        for (std::size_t i = 0; i < config_.effectors.size(); ++i)
            facts_.effectors.push_back({"effector_" + std::to_string(i), config_.effectors[i]});
        facts_.outcome_size = config_.outcome_size;
        facts_.max_batch = config_.max_batch;
        facts_.width = 10;
        facts_.height = 5;
    }
    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override { return std::make_unique<ToyLife>(*this); }

private:
    class ToyLife final : public Life {
    public:
        explicit ToyLife(ToyWorld const& world) : world_(world), done_(world.facts_.effectors.size()) {}
        Position sense(std::span<float> sensors) const override {
            for (std::size_t i = 0; i < sensors.size(); ++i) {
                float const value = phase(static_cast<float>(i));
                sensors[i] = world_.config_.sensors[i] ? (value > 0.5f ? 1.0f : 0.0f) : value;
            }
            return {10 * phase(0.3f), 5 * phase(0.7f)};
        }
        StepResult act(std::span<float const> effectors) override {
            for (std::size_t i = 0; i < effectors.size(); ++i)
                done_[i] += effectors[i] * (1.0f + 0.25f * static_cast<float>(i));
            ++steps_;
            return {phase(2.5f) - 0.5f, done_[0] > world_.config_.end_above};
        }
        void outcome(std::span<float> values) const override {
            for (std::size_t i = 0; i < values.size(); ++i) values[i] = phase(static_cast<float>(i) + 0.1f) * 100;
        }

    private:
        /// In [0, 1): a fraction of what was done so far, other for every `shift`.
        float phase(float shift) const {
            float sum = shift * 0.618f + static_cast<float>(steps_) * 0.01f;
            for (float const amount : done_) sum += amount * (0.37f + shift * 0.05f);
            return sum - std::floor(sum);
        }
        ToyWorld const& world_;
        std::vector<float> done_;
        int steps_ = 0;
    };

    ToyWorldConfig config_;
    WorldFacts facts_;
};

/// Between 1 and `most_sensors` sensors and 1 and `most_effectors` effectors, each binary or not by a coin.
inline ToyWorldConfig random_toy(Stream& rng, int most_sensors = 64, int most_effectors = 16) {
    ToyWorldConfig config;
    config.sensors.resize(1 + rng.below(static_cast<std::uint32_t>(most_sensors)));
    config.effectors.resize(1 + rng.below(static_cast<std::uint32_t>(most_effectors)));
    for (std::vector<bool>* kinds : {&config.sensors, &config.effectors})
        for (std::size_t i = 0; i < kinds->size(); ++i) (*kinds)[i] = rng.coin();
    config.outcome_size = static_cast<int>(rng.below(5));
    config.max_batch = rng.coin() ? most_lives : 1 + static_cast<int>(rng.below(9));
    config.end_above = rng.coin() ? 1e9f : 5 + static_cast<float>(rng.below(100));
    return config;
}

/// A founder of the world's interface that was mutated often enough to have hidden neurons.
inline Genome random_genome(World const& world, std::uint64_t seed, std::uint32_t slot) {
    Genome genome = founder(Interface{Channels{world.facts()}}, Stream{seed, Purpose::test, 0, slot});
    MutationConfig config;
    config.add_neuron_probability = config.add_edge_probability = 0.5;
    Stream rng{seed, Purpose::test, 1, slot};
    for (std::uint32_t i = 0; i < slot % 12; ++i) mutate(genome, config, {}, rng);
    return genome;
}

}   // namespace lore::test
