#include "batch_support.h"
#include "support/robot.h"

#include <lore/collectball/channels.h>
#include <lore/collectball/collectball.h>
#include <lore/evaluation/evaluation_queue.h>
#include <lore/network/mutation.h>

#include <memory>
#include <set>

using namespace lore;
using namespace lore::test;

namespace {

std::shared_ptr<World const> world(std::string const& task, int stop_when_still = 0) {
    return std::make_shared<CollectballWorld>(load_arena("collectball", task), stop_when_still);
}

// A channel's number is that of its neuron.
constexpr int left_wheel = static_cast<int>(Channel::left_wheel), right_wheel = static_cast<int>(Channel::right_wheel),
              collect = static_cast<int>(Channel::collect);

/// Sets the gene of an edge so that it decodes to `weight`.
void join(Genome& genome, int source, int target, float weight) {
    std::erase_if(genome.edges, [&](Edge const& edge) { return edge.source == source && edge.target == target; });
    genome.edges.push_back(
        {static_cast<NeuronIndex>(source), static_cast<NeuronIndex>(target), (weight + 5.0f) / 10.0f});
}

/// Drives ahead, turns away from what its sensors meet, collects always or where no basket is seen: gets about.
Genome wanderer(Stream& rng) {
    Genome genome{robot, {}, {0.5f, 0.5f, 0.5f}};
    bool const right_handed = rng.coin();
    float const strength = static_cast<float>(rng.uniform(2.0, 5.0));
    genome.biases[0] = genome.biases[1] = static_cast<float>(rng.uniform(0.38, 0.48));
    genome.biases[2] = static_cast<float>(rng.uniform(0.35, 0.45));
    int const slow = right_handed ? right_wheel : left_wheel, fast = right_handed ? left_wheel : right_wheel;
    for (int sensor : {0, 1, 2}) join(genome, sensor, slow, -strength);
    join(genome, right_handed ? 0 : 1, fast, static_cast<float>(rng.uniform(-1.0, 3.0)));
    for (int light : {3, 5, 7}) {   // towards what shines
        float const pull = static_cast<float>(rng.uniform(-1.0, 5.0));
        join(genome, light, left_wheel, pull);
        join(genome, light + 1, right_wheel, pull);
    }
    for (int bumper : {9, 10}) join(genome, bumper, slow, -5.0f);
    for (int basket : {5, 6}) join(genome, basket, collect, static_cast<float>(rng.uniform(-5.0, 0.0)));
    return genome;
}

/// Founders and wanderers, mutated up to some hundred times, with networks of 0 to 30 hidden neurons.
std::vector<Genome> population(int count, std::uint32_t seed) {
    std::vector<Genome> genomes;
    for (int i = 0; i < count; ++i) {
        Stream rng{seed, Purpose::test, 7, static_cast<std::uint32_t>(i)};
        Genome genome = i % 3 == 0 ? founder(robot, rng) : wanderer(rng);
        MutationConfig mutation;
        if (i % 4 == 3) mutation.add_neuron_probability = mutation.add_edge_probability = 0.5;
        std::uint32_t const mutations = i % 3 == 0 ? rng.below(400) : rng.below(i % 4 == 3 ? 60 : 6);
        for (std::uint32_t k = 0; k < mutations; ++k) mutate(genome, mutation, {}, rng);
        genomes.push_back(std::move(genome));
    }
    return genomes;
}

/// Robots that get about and earn rewards: the best of some rounds of selection among wanderers, by the fast path,
/// which is judged by what it says of them afterwards.
std::vector<Genome> skilled(std::string const& task, int count) {
    EvaluationContext const context{world(task), {2000}, {}};
    std::vector<Genome> genomes;
    for (std::uint32_t i = 0; i < 600; ++i) {
        Stream rng{11, Purpose::test, 8, i};
        genomes.push_back(wanderer(rng));
    }
    for (std::uint32_t round = 0; round < 6; ++round) {
        auto const evaluations = evaluate_batch(context, pointers_to(genomes));
        std::vector<std::pair<int, std::size_t>> scores;
        for (std::size_t i = 0; i < genomes.size(); ++i) {
            Descriptors const& d = evaluations[i].descriptors;
            std::set<std::pair<int, int>> tiles;
            for (Tile tile : d.path) tiles.insert({tile.x, tile.y});
            bool const carried =
                std::ranges::any_of(d.channel_bits, [](std::uint16_t word) { return (word >> 8 & 1) != 0; });
            scores.push_back(
                {-100 * static_cast<int>(evaluations[i].reward) - 30 * carried - static_cast<int>(tiles.size()), i});
        }
        std::ranges::sort(scores);
        std::vector<Genome> next;
        for (std::size_t i = 0; i < 100; ++i) next.push_back(genomes[scores[i].second]);
        for (std::uint32_t i = 0; i < 500; ++i) {
            next.push_back(next[i % 100]);
            Stream rng{11, Purpose::test, 9 + round, i};
            mutate(next.back(), {}, {}, rng);
        }
        genomes = std::move(next);
    }
    genomes.resize(static_cast<std::size_t>(count));
    return genomes;
}

/// A knowledge base of what some wanderers did.
Shaper shaper_from(std::string const& task, int individuals, ShapingRule rule = ShapingRule::max,
                   int window_length = 20) {
    return shaper_of(*world(task), population(individuals, 99), {window_length}, rule);
}

}   // namespace

class EvaluateBatch : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Task, EvaluateBatch, testing::Values("source", "target"));

TEST_P(EvaluateBatch, equals_the_plain_evaluation_to_the_bit) {
    EvaluationContext const context{world(GetParam()), {4000}, {}};
    auto genomes = population(30, 1);
    for (Genome& genome : skilled(GetParam(), 30)) genomes.push_back(std::move(genome));
    auto const plain = evaluate_all_plainly(context, genomes);
    expect_batches_equal(context, genomes, plain);

    // The comparison means something only if the robots do things.
    int touched = 0, carried = 0;
    for (Evaluation const& e : plain) {
        touched +=
            std::ranges::any_of(e.descriptors.channel_bits, [](std::uint16_t word) { return (word >> 6 & 3) != 0; });
        carried +=
            std::ranges::any_of(e.descriptors.channel_bits, [](std::uint16_t word) { return (word >> 8 & 1) != 0; });
    }
    EXPECT_GT(touched, 20);
    EXPECT_GT(carried, 10);
}

TEST_P(EvaluateBatch, serves_every_batch_size) {
    EvaluationContext const context{world(GetParam()), {700}, {}};
    auto const genomes = population(40, 2);
    auto const plain = evaluate_all_plainly(context, genomes);
    Isa const before = active_isa();
    for (Isa isa : usable_isas()) {
        use_isa(isa);
        for (std::size_t size = 0; size <= genomes.size(); ++size) {
            auto const all = pointers_to(genomes);
            auto const fast = evaluate_batch(context, std::span{all}.last(size));
            ASSERT_EQ(fast.size(), size);
            for (std::size_t i = 0; i < size; ++i)
                ASSERT_TRUE(fast[i] == plain[genomes.size() - size + i]) << name(isa) << ' ' << size << ' ' << i;
        }
    }
    use_isa(before);
}

TEST_P(EvaluateBatch, gives_the_same_from_a_queue_that_stutters) {
    /// Has nothing to hand out most of the time, so that lanes idle between episodes.
    class StutteringQueue : public EvaluationQueue {
    public:
        explicit StutteringQueue(std::vector<Genome> const& genomes) : results(genomes.size()), genomes_(genomes) {}
        std::optional<Item> next() override {
            if (next_ == genomes_.size() || (under_way_ > 0 && rng_.below(20) != 0)) return std::nullopt;
            ++under_way_;
            int const ticket = static_cast<int>(next_++);
            return Item{ticket, &genomes_[static_cast<std::size_t>(ticket)]};
        }
        void deliver(int ticket, Evaluation evaluation) override {
            --under_way_;
            results[static_cast<std::size_t>(ticket)] = std::move(evaluation);
        }
        std::vector<Evaluation> results;

    private:
        std::vector<Genome> const& genomes_;
        std::size_t next_ = 0;
        int under_way_ = 0;
        Stream rng_{1, Purpose::test};
    };
    EvaluationContext const context{world(GetParam()), {700}, std::nullopt};
    auto const genomes = population(40, 5);
    for (Isa isa : usable_isas()) {
        use_isa(isa);
        StutteringQueue queue{genomes};
        evaluate_queue(context, queue);
        for (std::size_t i = 0; i < genomes.size(); ++i)
            EXPECT_EQ(queue.results[i], evaluate_plainly(context, genomes[i])) << i << " " << name(isa);
    }
}

TEST_P(EvaluateBatch, gives_the_shaping_value_of_a_knowledge_base) {
    EvaluationContext const context{world(GetParam()), {2000}, shaper_from(GetParam(), 12)};
    auto const genomes = population(40, 3);
    auto const plain = evaluate_all_plainly(context, genomes);
    expect_batches_equal(context, genomes, plain);
    EXPECT_GT(std::ranges::count_if(plain, [](Evaluation const& e) { return e.shaping >= 0.0; }), 5);
}

TEST_P(EvaluateBatch, gives_what_every_shaping_rule_needs) {
    // Robots that come to rest show one window many times.
    std::vector<Genome> genomes{{robot, {}, {0.5f, 0.5f, 0.5f}}, {robot, {}, {0.3f, 0.3f, 0.0f}}};
    for (Genome& genome : population(30, 8)) genomes.push_back(std::move(genome));
    for (ShapingRule const rule : {ShapingRule::distinct, ShapingRule::sum, ShapingRule::share}) {
        EvaluationContext const context{world(GetParam()), {1990}, shaper_from(GetParam(), 12, rule)};
        auto const plain = evaluate_all_plainly(context, genomes);
        expect_batches_equal(context, genomes, plain);
        EXPECT_GT(
            std::ranges::count_if(plain, [](Evaluation const& e) { return e.shaping > 0.0 || e.shown.size() > 1; }), 5)
            << name(rule);
        if (HasFailure()) FAIL() << name(rule);
    }
}

TEST_P(EvaluateBatch, serves_windows_of_any_length) {
    auto const genomes = population(20, 4);
    for (int length : {1, 7, 33, 64, 150}) {
        EvaluationContext const context{world(GetParam()), {500}, shaper_from(GetParam(), 6, ShapingRule::max, length)};
        expect_batches_equal(context, genomes, evaluate_all_plainly(context, genomes));
        if (HasFailure()) FAIL() << "window length " << length;
    }
}

TEST_P(EvaluateBatch, stops_when_still_as_the_plain_evaluation_does) {
    auto const genomes = population(40, 5);
    for (int still : {1, 100}) {
        EvaluationContext const context{world(GetParam(), still), {1500}, shaper_from(GetParam(), 6)};
        auto const plain = evaluate_all_plainly(context, genomes);
        expect_batches_equal(context, genomes, plain);
        EXPECT_TRUE(
            std::ranges::any_of(plain, [](Evaluation const& e) { return e.descriptors.channel_bits.size() < 1500; }));
    }
}

TEST_P(EvaluateBatch, finishes_robots_at_rest_with_the_same_result) {
    // Without edges the wheels are constants: standing still, and pushing against a wall without turning.
    std::vector<Genome> genomes{{robot, {}, {0.5f, 0.5f, 0.5f}},
                                {robot, {}, {0.3f, 0.3f, 0.0f}},
                                {robot, {}, {0.3f, 0.3f, 1.0f}},
                                {robot, {}, {0.7f, 0.7f, 1.0f}}};
    for (Genome& genome : population(30, 6)) genomes.push_back(std::move(genome));
    EvaluationContext const context{world(GetParam()), {3999}, shaper_from(GetParam(), 6)};
    expect_batches_equal(context, genomes, evaluate_all_plainly(context, genomes));
}

TEST_P(EvaluateBatch, serves_episodes_of_any_length) {
    auto const genomes = population(20, 7);
    for (int steps : {1, 2, 19, 20, 39, 40, 41, 50, 51, 99}) {
        EvaluationContext const context{world(GetParam()), {steps}, shaper_from(GetParam(), 3)};
        expect_batches_equal(context, genomes, evaluate_all_plainly(context, genomes));
        if (HasFailure()) FAIL() << steps << " steps";
    }
}
