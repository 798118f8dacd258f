#include "knowledge/traces.h"

#include <lore/core/error.h>
#include <lore/knowledge/derive.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;

namespace {

KnowledgeBase base_of(std::initializer_list<test::Step> features, std::vector<double> const& values) {
    Provenance provenance;
    provenance.kind = "lineage";
    provenance.sources = {"runs/s1"};
    return test::base_of(features, values, 3, provenance);
}

KnowledgeBase const four = base_of({{0x000, 0.1f}, {0x01F, 0.2f}, {0x1E0, 0.3f}, {0x1FF, 0.4f}}, {2.0, 5.0, 0.5, 5.0});

std::vector<double> values_of(KnowledgeBase const& base) { return {base.values().begin(), base.values().end()}; }

}   // namespace

TEST(Randomize, draws_values_between_the_smallest_and_the_largest_and_keeps_everything_else) {
    KnowledgeBase const random = randomize(four, 1);
    ASSERT_EQ(random.size(), 4);
    for (int i = 0; i < 4; ++i) {
        EXPECT_GE(random.value(i), 0.5);
        EXPECT_LT(random.value(i), 5.0);
        EXPECT_EQ(random.reward_sum(i), four.reward_sum(i));
        EXPECT_EQ(random.count(i), 3u);
        EXPECT_EQ(squared_distance(four.config().channels, random.window(i), four.window(i)), 0.0f);
    }
    EXPECT_EQ(random.provenance().kind, "random");
    EXPECT_EQ(random.provenance().sources, four.provenance().sources);
    EXPECT_EQ(random.provenance().derivation.size(), 1u);
}

TEST(Randomize, is_a_function_of_the_seed) {
    EXPECT_EQ(values_of(randomize(four, 7)), values_of(randomize(four, 7)));
    EXPECT_NE(values_of(randomize(four, 7)), values_of(randomize(four, 8)));
}

TEST(Permute, gives_the_same_values_to_other_features) {
    Stream rng{3, Purpose::test};
    for (int round = 0; round < 200; ++round) {
        std::size_t const size = rng.below(40);
        Trace trace;
        trace.channels = collectball_channels();
        std::vector<double> values;
        for (std::size_t i = 0; i < size; ++i) {
            trace.channel_bits.push_back(static_cast<std::uint16_t>(i));
            trace.values.insert(trace.values.end(), continuous_count, 0.5f);
            values.push_back(rng.below(4));   // many equal ones
        }
        KnowledgeBase const base{
            test::config_of(1),
            {},
            {trace.channel_bits, trace.values, values, values, std::vector<std::uint32_t>(size, 1)}};
        KnowledgeBase const permuted = permute(base, static_cast<std::uint64_t>(round));
        std::vector<double> sorted = values_of(permuted);
        std::sort(sorted.begin(), sorted.end());
        std::sort(values.begin(), values.end());
        EXPECT_EQ(sorted, values);
        for (int i = 0; i < permuted.size(); ++i) {
            EXPECT_EQ(permuted.window(i).bits[0], base.window(i).bits[0]);
            EXPECT_EQ(permuted.reward_sum(i), base.reward_sum(i));
        }
    }
}

TEST(Permute, is_a_function_of_the_seed_and_says_so_in_the_provenance) {
    std::vector<double> const distinct{0, 1, 2, 3, 4, 5, 6, 7};
    KnowledgeBase const base = base_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {7, 0}}, distinct);
    KnowledgeBase const permuted = permute(base, 7);
    EXPECT_EQ(values_of(permuted), values_of(permute(base, 7)));
    EXPECT_NE(values_of(permuted), values_of(permute(base, 8)));
    EXPECT_NE(values_of(permuted), distinct);
    EXPECT_NE(values_of(permuted), values_of(randomize(base, 7)));
    EXPECT_EQ(permuted.provenance().kind, "permuted");
    EXPECT_EQ(permuted.provenance().derivation, std::vector<std::string>{"values shuffled with seed 7"});
}

TEST(KeepTop, keeps_the_most_valued_with_the_lower_number_first_among_equals_in_the_old_order) {
    EXPECT_EQ(values_of(keep_top(four, 3)), (std::vector<double>{2.0, 5.0, 5.0}));
    KnowledgeBase const one = keep_top(four, 1);
    ASSERT_EQ(one.size(), 1);
    EXPECT_EQ(one.window(0).bits[0], 0x01F);
    EXPECT_EQ(keep_top(four, 99).size(), 4);
    EXPECT_EQ(keep_top(four, 0).size(), 0);
}

TEST(KeepValued, keeps_the_bound_itself) {
    EXPECT_EQ(values_of(keep_valued(four, 2.0)), (std::vector<double>{2.0, 5.0, 5.0}));
    EXPECT_EQ(keep_valued(four, 5.01).size(), 0);
}

TEST(KeepShown, keeps_what_so_many_individuals_have_shown) {
    KnowledgeArrays arrays{{1, 2, 3}, std::vector<float>(3 * 6), {2.0, 8.0, 5.0}, {20.0, 8.0, 15.0}, {10, 1, 3}};
    KnowledgeBase const base{four.config(), {}, std::move(arrays)};
    EXPECT_EQ(values_of(keep_shown(base, 1)), (std::vector<double>{2.0, 8.0, 5.0}));
    EXPECT_EQ(values_of(keep_shown(base, 3)), (std::vector<double>{2.0, 5.0}));
    EXPECT_EQ(keep_shown(base, 11).size(), 0);
}

TEST(KeepConsensus, keeps_what_matches_in_every_other_base) {
    KnowledgeBase const others[]{base_of({{0x001, 0.1f}, {0x01F, 0.2f}}, {1, 1}),
                                 base_of({{0x000, 0.1f}, {0x1E0, 0.3f}}, {1, 1})};
    KnowledgeBase const shared = keep_consensus(four, others);
    ASSERT_EQ(shared.size(), 1);
    EXPECT_EQ(shared.value(0), 2.0);
    EXPECT_EQ(shared.provenance().kind, "reduced");
}

TEST(KeepConsensus, refuses_windows_of_other_channels) {
    KnowledgeBase const other{{1, 1.83f, Channels{{{"light", true}}, {{"motor", false}}}}, {}, {}};
    EXPECT_THROW(keep_consensus(four, {&other, 1}), UsageError);
}

TEST(KeepConsensus, refuses_windows_of_another_length) {
    KnowledgeBase const other{test::config_of(2), {}, {}};
    EXPECT_THROW(keep_consensus(four, {&other, 1}), UsageError);
}
