// Batches in worlds of any channels, whose rewards are fractions of both signs.
#include "batch_support.h"
#include "support/toy_world.h"

#include <lore/episode/lanes.h>

#include <array>
#include <cmath>
#include <memory>

using namespace lore;
using namespace lore::test;

namespace {

std::vector<Genome> population(World const& world, int count) {
    std::vector<Genome> genomes;
    for (int i = 0; i < count; ++i) genomes.push_back(random_genome(world, 41, static_cast<std::uint32_t>(i)));
    return genomes;
}

/// Half of them taught the knowledge base, so that they show its features.
Shaper shaper_for(World const& world, int individuals, KnowledgeConfig const& config, ShapingRule rule) {
    return shaper_of(world, population(world, individuals / 2), config, rule);
}

struct Shape {
    std::string name;
    ToyWorldConfig config;
};
void PrintTo(Shape const& shape, std::ostream* out) { *out << shape.name; }

std::vector<bool> const binary{true}, continuous{false};
std::vector<bool> many(int count, bool is_binary) {
    return std::vector<bool>(static_cast<std::size_t>(count), is_binary);
}
std::vector<bool> in_turn(int count) {
    std::vector<bool> kinds;
    for (int i = 0; i < count; ++i) kinds.push_back(i % 2 == 0);
    return kinds;
}

std::vector<Shape> shapes() {
    return {{"one_of_each_kind", {binary, continuous, 1, most_lives}},
            {"one_of_each_kind_the_other_way", {continuous, binary, 3, most_lives}},
            {"binary_alone", {many(9, true), many(3, true), 0, most_lives}},
            {"continuous_alone", {many(14, false), many(2, false), 7, most_lives}},
            {"seventeen_binary", {many(14, true), many(3, true), 5, most_lives}},
            {"seventeen_continuous", {many(14, false), many(3, false), 5, most_lives}},
            {"all_that_are_possible", {in_turn(64), in_turn(16), 255, most_lives}},
            {"all_binary", {many(64, true), many(16, true), 1, most_lives}},
            {"one_at_a_time", {in_turn(20), in_turn(3), 3, 1}},
            {"five_at_a_time", {in_turn(11), in_turn(2), 3, 5}},
            {"lives_that_end", {in_turn(11), continuous, 3, most_lives, 40}},
            {"five_lives_that_end", {in_turn(40), continuous, 3, 5, 20}}};
}

}   // namespace

class EvaluateBatchOfWorld : public testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Channels, EvaluateBatchOfWorld, testing::ValuesIn(shapes()),
                         [](auto const& shape) { return shape.param.name; });

TEST_P(EvaluateBatchOfWorld, equals_the_plain_evaluation_to_the_bit) {
    EvaluationContext const context{std::make_shared<ToyWorld>(GetParam().config), {230}, {}};
    auto const genomes = population(*context.world, 40);
    auto const plain = evaluate_all_plainly(context, genomes);
    expect_batches_equal(context, genomes, plain);

    // The comparison means something only if individuals differ, and where lives end, they do so at different steps.
    auto const count_of = [&](auto const& condition) { return std::ranges::count_if(plain, condition); };
    EXPECT_GT(count_of([&](Evaluation const& e) { return e.reward != plain[0].reward; }), 20);
    EXPECT_GT(count_of([](Evaluation const& e) { return e.reward < 0; }), 0);
    EXPECT_GT(count_of([](Evaluation const& e) { return e.reward != std::floor(e.reward); }), 20);
    if (GetParam().config.end_above < 230) {
        EXPECT_GT(count_of([&](Evaluation const& e) { return e.descriptors.steps() < 230; }), 10);
        EXPECT_GT(count_of([&](Evaluation const& e) { return e.descriptors.steps() != plain[0].descriptors.steps(); }),
                  10);
    }
}

TEST_P(EvaluateBatchOfWorld, gives_what_every_shaping_rule_needs) {
    auto const world = std::make_shared<ToyWorld>(GetParam().config);
    auto const genomes = population(*world, 12);
    for (ShapingRule const rule : {ShapingRule::max, ShapingRule::distinct, ShapingRule::sum, ShapingRule::share}) {
        EvaluationContext const context{world, {130}, shaper_for(*world, 12, {.window_length = 7}, rule)};
        auto const plain = evaluate_all_plainly(context, genomes);
        expect_batches_equal(context, genomes, plain);
        EXPECT_GT(std::ranges::count_if(
                      plain, [](Evaluation const& e) { return e.shaping != no_feature_value || e.shown.size() > 1; }),
                  5)
            << name(rule);
        if (HasFailure()) FAIL() << name(rule);
    }
}

TEST(EvaluateBatchOfAnyWorld, equals_the_plain_evaluation_in_worlds_of_random_shapes) {
    for (std::uint32_t shape = 0; shape < 40; ++shape) {
        SCOPED_TRACE("shape " + std::to_string(shape));
        Stream rng{42, Purpose::test, 0, shape};
        auto const world = std::make_shared<ToyWorld>(random_toy(rng));
        int const individuals = 1 + static_cast<int>(rng.below(50));
        EvaluationContext context{world, {1 + static_cast<int>(rng.below(150))}, {}};
        if (shape % 4 == 0) {
            KnowledgeConfig const config{.window_length = 1 + static_cast<int>(rng.below(60))};
            context.shaper = shaper_for(*world, individuals, config, ShapingRule::sum);
        }
        auto const genomes = population(*world, individuals);
        expect_batches_equal(context, genomes, evaluate_all_plainly(context, genomes));
        if (HasFailure()) break;
    }
}

TEST(EvaluateBatchOfAnyWorld, counts_the_bits_of_long_episodes) {
    EvaluationContext const context{std::make_shared<ToyWorld>(ToyWorldConfig{in_turn(40), in_turn(3)}), {2100}, {}};
    auto const genomes = population(*context.world, 10);
    expect_batches_equal(context, genomes, evaluate_all_plainly(context, genomes));
}

namespace {

constexpr int first_still_step = 30;

/// From first_still_step on, what a life senses stays, and as it runs its episodes in lanes by itself, one after the
/// other, it says so.
class StillWorld : public LaneWorld {
public:
    StillWorld() {
        for (int i = 0; i < 40; ++i) facts_.sensors.push_back({"sensor_" + std::to_string(i), i % 2 == 0});
        facts_.effectors = {{"effector_0", true}, {"effector_1", false}};
        facts_.name = facts_.task = "still";
        facts_.outcome_size = 1;
    }
    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override { return std::make_unique<StillLife>(); }
    void run_in_lanes(EpisodeConfig const& config, int chunk_steps, LaneClient& client) const override {
        while (Network const* network = client.next(0))
            run_episode(record_episode(*this, *network, config), chunk_steps, client);
    }

private:
    class StillLife : public Life {
    public:
        Position sense(std::span<float> sensors) const override {
            int const step = std::min(steps_, first_still_step);
            for (std::size_t i = 0; i < sensors.size(); ++i) {
                float const value = static_cast<float>((static_cast<int>(i) * 7 + step * 3) % 11) / 10.0f;
                sensors[i] = i % 2 == 0 ? std::round(value) : value;
            }
            return {static_cast<float>(step) / 40, 0.5f};
        }
        StepResult act(std::span<float const> effectors) override {
            return {steps_++ < first_still_step ? effectors[1] - 0.5f : 0.0f, false};
        }
        void outcome(std::span<float> values) const override { values[0] = 5; }

    private:
        int steps_ = 0;
    };

    void run_episode(Trace const& trace, int chunk_steps, LaneClient& client) const {
        Channels const channels{facts_};
        int const width = lane_count(), words = channels.words(), continuous = channels.continuous_count();
        std::vector<std::uint16_t> bits(static_cast<std::size_t>(chunk_steps * words * width));
        std::vector<float> values(static_cast<std::size_t>(chunk_steps * continuous * width)),
            x(static_cast<std::size_t>(chunk_steps * width)), y = x;
        int done = 0;
        while (done < trace.steps() && done <= first_still_step) {
            int const rows = std::min(chunk_steps, trace.steps() - done);
            auto const lane_0 = [&](auto const& from, auto& to, int columns) {
                for (int i = 0; i < rows * columns; ++i)
                    to[static_cast<std::size_t>(i * width)] = from[static_cast<std::size_t>(done * columns + i)];
            };
            lane_0(trace.channel_bits, bits, words);
            lane_0(trace.values, values, continuous);
            for (int row = 0; row < rows; ++row) {
                x[static_cast<std::size_t>(row * width)] = trace.positions[static_cast<std::size_t>(done + row)].x;
                y[static_cast<std::size_t>(row * width)] = trace.positions[static_cast<std::size_t>(done + row)].y;
            }
            std::array<int, most_lanes> valid{rows};
            client.see({width, chunk_steps, values.data(), bits.data(), x.data(), y.data(), {}},
                       {valid.data(), static_cast<std::size_t>(width)});
            done += rows;
        }
        if (done < trace.steps()) client.rest(0, trace.steps() - done);
        client.end(0, {trace.reward, trace.outcome});
    }

    WorldFacts facts_;
};

}   // namespace

TEST(EvaluateBatchOfAnyWorld, repeats_the_last_row_of_an_episode_at_rest) {
    auto const world = std::make_shared<StillWorld>();
    // Without hidden neurons, so that the effectors stay too.
    std::vector<Genome> genomes;
    for (std::uint32_t i = 0; i < 5; ++i)
        genomes.push_back(founder(Interface{Channels{world->facts()}}, Stream{43, Purpose::test, 0, i}));
    for (int const steps : {20, 39, 40, 41, 300, 1999}) {
        EvaluationContext const context{
            world, {steps}, shaper_of(*world, {genomes[0], genomes[1]}, {.window_length = 20}, ShapingRule::sum)};
        expect_batches_equal(context, genomes, evaluate_all_plainly(context, genomes));
        if (HasFailure()) FAIL() << steps << " steps";
    }
}
