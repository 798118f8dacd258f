#include "knowledge/traces.h"

#include <lore/knowledge/builder.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;
using lore::test::trace_of;

namespace {

KnowledgeConfig const two_steps = test::config_of(2);

/// Windows of two steps; A, B, C and D are more than the threshold apart (5 bits or more), a resembles A (distance 1).
constexpr test::Step A0{0x000, 0.5f}, A1{0x000, 0.5f}, a0{0x001, 0.5f}, B0{0x01F, 0.5f}, C0{0x1E0, 0.5f},
    D0{0x1FF, 0.5f};

}   // namespace

TEST(KnowledgeBuilder, follows_algorithm_1_on_a_lineage_of_three) {
    KnowledgeBuilder builder{two_steps, make_scan_index(two_steps)};
    // The best-of-run (reward 7) shows A, B, A; its parent (4) shows a, C; the founder (0) shows D, B.
    Trace const best = trace_of({A0, A1, B0, A1, A0, A1});
    Trace const parent = trace_of({a0, A1, C0, A1});
    Trace const founder = trace_of({D0, A1, B0, A1});
    builder.add_individual({windows_of(best, 2), 7});
    EXPECT_EQ(builder.features(), 2);
    builder.add_individual({windows_of(parent, 2), 4});
    builder.add_individual({windows_of(founder, 2), 0});
    EXPECT_EQ(builder.features(), 4);
    EXPECT_EQ(builder.individuals(), 3u);
    EXPECT_EQ(builder.windows(), 7u);
    EXPECT_EQ(builder.matched(), 3u);   // A again, a as A, B again

    Provenance told;
    told.kind = "lineage";
    KnowledgeBase const base = std::move(builder).finish(told);
    ASSERT_EQ(base.size(), 4);
    // A: (7 + 4) / 2 although the best showed it twice; B: (7 + 0) / 2; C: 4 / 1; D: 0 / 1.
    EXPECT_EQ(base.value(0), 5.5);
    EXPECT_EQ(base.reward_sum(0), 11);
    EXPECT_EQ(base.count(0), 2u);
    EXPECT_EQ(base.value(1), 3.5);
    EXPECT_EQ(base.reward_sum(1), 7);
    EXPECT_EQ(base.count(1), 2u);
    EXPECT_EQ(base.value(2), 4.0);
    EXPECT_EQ(base.count(2), 1u);
    EXPECT_EQ(base.value(3), 0.0);
    EXPECT_EQ(base.count(3), 1u);
    // A feature stays as it was first met: the parent's variant did not replace it.
    EXPECT_EQ(base.window(0).bits[0], 0);
    EXPECT_EQ(base.window(2).bits[0], 0x1E0);
    EXPECT_EQ(base.provenance().kind, "lineage");
    EXPECT_EQ(base.provenance().individuals, 3u);
    EXPECT_EQ(base.provenance().windows, 7u);
}

TEST(KnowledgeBuilder, depends_on_the_order_of_individuals) {
    // b lies between A and c: the first of them becomes the feature that the others match or miss.
    Trace const A = trace_of({{0x000, 0.5f}, {0, 0.5f}}), b = trace_of({{0x003, 0.5f}, {0, 0.5f}}),
                c = trace_of({{0x00F, 0.5f}, {0, 0.5f}});
    KnowledgeBuilder forward{two_steps, make_scan_index(two_steps)},
        middle_first{two_steps, make_scan_index(two_steps)};
    for (Trace const* trace : {&A, &b, &c}) forward.add_individual({windows_of(*trace, 2), 1});
    for (Trace const* trace : {&b, &A, &c}) middle_first.add_individual({windows_of(*trace, 2), 1});
    EXPECT_EQ(forward.features(), 2);
    EXPECT_EQ(middle_first.features(), 1);
}

TEST(KnowledgeBuilder, makes_an_empty_base_of_nothing) {
    KnowledgeBase const base = KnowledgeBuilder{two_steps, make_scan_index(two_steps)}.finish({});
    EXPECT_EQ(base.size(), 0);
    EXPECT_EQ(base.config().window_length, 2);
}

TEST(KnowledgeBuilder, keeps_only_channels_of_the_words) {
    KnowledgeBuilder builder{two_steps, make_scan_index(two_steps)};
    Trace const trace = trace_of({{0x7E01, 0.5f}, {0x0200, 0.5f}});
    builder.add_individual({windows_of(trace, 2), 1});
    KnowledgeBase const base = std::move(builder).finish({});
    EXPECT_EQ(base.window(0).bits[0], 1);
    EXPECT_EQ(base.window(0).bits[1], 0);
}

TEST(KnowledgeBuilder, gives_the_same_base_one_by_one_and_in_batches_by_any_number_of_threads) {
    KnowledgeConfig const config = test::config_of();
    Stream rng{51, Purpose::test};
    std::vector<Trace> traces;
    for (int i = 0; i < 24; ++i)
        traces.push_back(i % 3 == 2 ? traces[static_cast<std::size_t>(i) - 2] : test::lifelike_trace(rng, 1000));
    std::vector<Exhibit> exhibits;
    for (std::size_t i = 0; i < traces.size(); ++i)
        exhibits.push_back({windows_of(traces[i], config.window_length), static_cast<double>(i % 5)});

    KnowledgeBuilder plain{config, make_scan_index(config)};
    for (Exhibit const& exhibit : exhibits) plain.add_individual(exhibit);
    std::uint64_t const matched = plain.matched();
    KnowledgeBase const expected = std::move(plain).finish({});
    EXPECT_GT(matched, 0u);
    for (int const threads : {1, 2, 5})
        for (std::size_t const batch : {1u, 7u, 24u}) {
            KnowledgeBuilder builder{config, make_exact_index(config)};
            Crew crew{threads};
            for (std::size_t first = 0; first < exhibits.size(); first += batch)
                builder.add_individuals(std::span{exhibits}.subspan(first, std::min(batch, exhibits.size() - first)),
                                        crew);
            EXPECT_EQ(builder.matched(), matched);
            EXPECT_EQ(builder.individuals(), exhibits.size());
            KnowledgeBase const base = std::move(builder).finish({});
            ASSERT_EQ(base.size(), expected.size());
            for (int i = 0; i < base.size(); ++i) {
                ASSERT_EQ(base.value(i), expected.value(i));
                ASSERT_EQ(base.count(i), expected.count(i));
                ASSERT_EQ(squared_distance(config.channels, base.window(i), expected.window(i)), 0.0f);
            }
        }
}
