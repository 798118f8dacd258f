// Of a copy of Lore with a compass as the 13th sensor and the fifth distance, `delivery` (extend.py).
#include "collectball/arena_support.h"
#include "behavior/random_descriptors.h"
#include "support/pointers.h"

#include <lore/archive/messages.h>
#include <lore/behavior/distance_matrix.h>
#include <lore/collectball/replay.h>
#include <lore/core/error.h>
#include <lore/core/isa.h>
#include <lore/evaluation/evaluator.h>
#include <lore/network/mutation.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace lore {

/// FLANN sees rows of numbers, and takes long to compile.
std::unique_ptr<GrowingIndex> make_flann_index(KnowledgeConfig const&, int, int) { return nullptr; }

}   // namespace lore

using namespace lore;
using lore::test::pointers_to;

namespace {

static_assert(sensor_count == 13 && continuous_count == 7 && channel_count == 16);
static_assert(distance_kinds == 5);

/// The copy has baseline kernels alone.
[[maybe_unused]] bool const only_baseline = (use_isa(Isa::baseline), true);

CollectballWorld const& world() {
    static CollectballWorld const source{
        parse_arena(tests::replaced(arena_text("collectball"), "\"carrying\"]", "\"carrying\", \"compass\"]"),
                    "compass", "source")};
    return source;
}

std::vector<Genome> population(int count) {
    std::vector<Genome> genomes;
    for (int i = 0; i < count; ++i) {
        Stream rng{1, Purpose::test, 0, static_cast<std::uint32_t>(i)};
        Genome genome = founder(Interface{collectball_channels()}, rng);
        MutationConfig often;
        often.add_neuron_probability = often.add_edge_probability = 0.5;
        for (int k = 0; k < 3 * i; ++k) mutate(genome, often, {}, rng);
        genomes.push_back(std::move(genome));
    }
    return genomes;
}

}   // namespace

TEST(OneMoreSensor, is_asked_for_in_the_arenas_file) {
    try {
        parse_arena(arena_text("collectball"), "without", "source");
        FAIL() << "an arena without the sensor was taken";
    } catch (Error const& error) {
        EXPECT_NE(std::string{error.what()}.find("'compass' is missing"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(world());
}

TEST(OneMoreSensor, is_connected_in_a_founder_and_recorded_in_its_trace) {
    Genome const genome = population(1)[0];
    EXPECT_EQ(genome.edges.size(), 13u * 3u);
    auto const rows = record_steps(world(), compile(genome), {50});
    Trace const trace = record_episode(world(), compile(genome), {50});
    ASSERT_EQ(trace.values.size(), 50u * 7u);
    auto const place = std::ranges::find(continuous_channels, static_cast<int>(Channel::compass));
    auto const compass = static_cast<std::size_t>(place - continuous_channels.begin());
    for (std::size_t step = 0; step < 50; ++step) {
        float const value = trace.values[step * 7 + compass];
        EXPECT_EQ(value, rows[step].pose.theta / 6.28318530717958f + 0.5f);
        EXPECT_EQ(trace.channel_bits[step] >> (binary_count + compass) & 1, value > 0.5f);
    }
}

TEST(OneMoreSensor, reads_the_same_in_lanes_and_plainly_to_the_bit) {
    EvaluationContext const context{std::make_shared<CollectballWorld>(world()), {1000}, std::nullopt};
    auto const genomes = population(20);
    auto const fast = evaluate_batch(context, pointers_to(genomes));
    for (std::size_t i = 0; i < genomes.size(); ++i)
        EXPECT_TRUE(fast[i] == evaluate_plainly(context, genomes[i])) << "individual " << i;
}

TEST(OneMoreDistance, is_known_by_its_name) {
    EXPECT_EQ(distance_kind("delivery"), DistanceKind::delivery);
    EXPECT_EQ(distance_names(), "adhoc, hamming, trajectory, entropy, delivery");
}

TEST(OneMoreDistance, is_measured_plainly_and_the_others_by_their_fast_twins) {
    Stream rng{2, Purpose::test};
    std::vector<Descriptors> pool;
    for (int i = 0; i < 40; ++i) pool.push_back(random_behavior(rng, 1000));
    for (int k = 0; k < distance_kinds; ++k) {
        auto const kind = static_cast<DistanceKind>(k);
        DistanceMatrix fast(40), plain(40);
        measure_rows(kind, pointers_to(pool), 0, 40, fast);
        measure_rows_plainly(kind, pointers_to(pool), 0, 40, plain);
        EXPECT_EQ(fast, plain) << name(kind);
        EXPECT_GT(std::ranges::max(plain.means()), 0) << name(kind);
    }
}

TEST(OneMoreDistance, travels_in_messages_with_what_it_needs) {
    Stream rng{3, Purpose::test};
    std::vector<Delivery> deliveries;
    for (int i = 0; i < 5; ++i)
        deliveries.push_back({i, {static_cast<double>(i), 0.5, {}, random_behavior(rng, 4000)}});
    EXPECT_EQ(unpack_deliveries(pack_deliveries(deliveries)), deliveries);
    EXPECT_NE(deliveries[0].evaluation.descriptors.delivered, deliveries[1].evaluation.descriptors.delivered);
}
