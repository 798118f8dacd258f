#include "knowledge/traces.h"

#include <lore/core/isa.h>
#include <lore/knowledge/index.h>
#include <lore/network/mutation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

using namespace lore;

namespace {

/// A trace near `original`: some bits flipped, some values moved, as if its controller had been mutated.
Trace variant_of(Trace const& original, Stream& rng, double flips, double moves) {
    Trace trace = original;
    for (std::uint16_t& word : trace.channel_bits)
        if (rng.chance(flips)) word ^= static_cast<std::uint16_t>(1u << rng.below(binary_count));
    for (float& value : trace.values)
        if (rng.chance(moves)) value = std::clamp(value + static_cast<float>(rng.uniform(-0.5, 0.5)), 0.0f, 1.0f);
    return trace;
}

std::vector<Window> windows_of_all(std::vector<Trace> const& traces, int window_length) {
    std::vector<Window> windows;
    for (Trace const& trace : traces)
        for (Window const& window : windows_of(trace, window_length)) windows.push_back(window);
    return windows;
}

/// Features of a few lives, and queries: the same lives and variants of them at every degree of likeness.
struct LivesShown {
    std::vector<Trace> known, asked;
    LivesShown(std::uint32_t slot, int traces, int steps) {
        Stream rng{11, Purpose::test, 0, slot};
        for (int i = 0; i < traces; ++i) {
            known.push_back(test::lifelike_trace(rng, steps));
            asked.push_back(known.back());
            for (double change : {0.005, 0.03, 0.1, 0.3})
                asked.push_back(variant_of(known.back(), rng, change, change));
            asked.push_back(test::lifelike_trace(rng, steps));
        }
    }
};

/// Restores the choice of the instruction set.
struct IsaGuard {
    Isa before = active_isa();
    ~IsaGuard() { use_isa(before); }
};

}   // namespace

class EveryConfiguration : public testing::TestWithParam<std::tuple<int, float>> {};
INSTANTIATE_TEST_SUITE_P(, EveryConfiguration,
                         testing::Combine(testing::Values(1, 7, 20, 40),
                                          testing::Values(0.5f, 1.0f, 1.83f, 3.0f, 6.0f)));

TEST_P(EveryConfiguration, gives_the_matches_of_the_scan) {
    auto const [window_length, threshold] = GetParam();
    KnowledgeConfig const config = test::config_of(window_length, threshold);
    LivesShown const lives{static_cast<std::uint32_t>(window_length), 3, 30 * window_length + 100};
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    auto const scan_search = scan->search(), exact_search = exact->search();
    std::vector<Window> const known = windows_of_all(lives.known, window_length);
    for (Window const& window : known) {
        scan->add(window);
        exact->add(window);
    }
    int found = 0;
    std::vector<Match> expected;
    std::vector<Window> const queries = windows_of_all(lives.asked, window_length);
    for (Window const& window : queries) {
        expected.push_back(scan_search->match(window));
        found += expected.back().found();
        ASSERT_EQ(exact_search->match(window), expected.back());
    }
    EXPECT_GT(found, 0);
    // Once the set is final, patterns are remembered: ask everything twice.
    KnowledgeBase const base = test::base_of(config, known, std::vector<double>(known.size(), 1.0));
    auto const final = make_final_exact_index(base);
    auto const final_search = final->search();
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = 0; i < queries.size(); ++i) ASSERT_EQ(final_search->match(queries[i]), expected[i]);
}

TEST_P(EveryConfiguration, finds_what_lies_just_inside_the_threshold_whatever_the_channel) {
    // Windows that differ from the feature in one way only, by as much as a match allows: the bounds are tight there.
    auto const [window_length, threshold] = GetParam();
    KnowledgeConfig const config = test::config_of(window_length, threshold);
    Trace feature;
    feature.channels = config.channels;
    feature.channel_bits.assign(static_cast<std::size_t>(window_length), 0);
    feature.values.assign(static_cast<std::size_t>(window_length * continuous_count), 0.0f);
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    scan->add(windows_of(feature, window_length)[0]);
    exact->add(windows_of(feature, window_length)[0]);
    auto const scan_search = scan->search(), exact_search = exact->search();
    for (int bits = 0; bits < 40; ++bits)
        for (int changed = 1; changed <= continuous_count * window_length; changed += 1 + window_length / 7) {
            Trace query = feature;
            for (int bit = 0; bit < bits && bit < window_length * binary_count; ++bit)
                query.channel_bits[static_cast<std::size_t>(bit % window_length)] |=
                    static_cast<std::uint16_t>(1u << bit / window_length);
            float const left = config.squared_threshold() - static_cast<float>(bits);
            if (left <= 0) break;
            for (float const share : {0.999f, 0.99999f, 1.0f, 1.00001f}) {
                float const level = std::sqrt(left / static_cast<float>(changed)) * share;
                if (level > 1) continue;
                for (int i = 0; i < changed; ++i) query.values[static_cast<std::size_t>(i)] = level;
                Window const window = windows_of(query, window_length)[0];
                ASSERT_EQ(exact_search->match(window), scan_search->match(window))
                    << bits << " bits, " << changed << " values of " << level;
            }
        }
}

TEST(ExactIndex, equals_the_scan_on_every_instruction_set_while_it_grows) {
    IsaGuard const guard;
    KnowledgeConfig const config = test::config_of();
    LivesShown const lives{5, 4, 2000};
    std::vector<Window> const windows = windows_of_all(lives.asked, config.window_length);
    auto const scan = make_scan_index(config);
    auto const scan_search = scan->search();
    std::vector<Match> expected;
    for (Window const& window : windows) {   // as the builder does
        expected.push_back(scan_search->match(window));
        if (!expected.back().found()) scan->add(window);
    }
    for (Isa isa : {Isa::baseline, Isa::v3, Isa::v4}) {
        if (isa > detected_isa()) continue;
        use_isa(isa);
        auto const exact = make_exact_index(config);
        auto const search = exact->search();
        for (std::size_t i = 0; i < windows.size(); ++i) {
            ASSERT_EQ(search->match(windows[i]), expected[i]) << name(isa);
            if (!expected[i].found()) exact->add(windows[i]);
        }
        EXPECT_EQ(exact->size(), scan->size());
    }
}

TEST(ExactIndex, equals_the_scan_where_the_nearest_differ_in_a_few_bits) {
    // Around a few patterns, so that a search finds matches early and must not end before the nearest is seen.
    for (float const threshold : {1.5f, 1.83f, 2.2f, 3.0f}) {   // 3, 4, 5 and 9 tables
        KnowledgeConfig const config = test::config_of(20, threshold);
        Stream rng{12, Purpose::test};
        std::vector<Trace> centers;
        for (int i = 0; i < 3; ++i) centers.push_back(test::lifelike_trace(rng, config.window_length));
        auto const near_a_center = [&] {
            Trace trace = centers[rng.below(3)];
            for (std::size_t flips = rng.below(7); flips > 0; --flips)
                trace.channel_bits[rng.below(20)] ^= static_cast<std::uint16_t>(1u << rng.below(binary_count));
            for (float& value : trace.values)
                value = std::clamp(value + static_cast<float>(rng.uniform(-0.03, 0.03)), 0.0f, 1.0f);
            return trace;
        };
        auto const scan = make_scan_index(config), exact = make_exact_index(config);
        auto const scan_search = scan->search(), exact_search = exact->search();
        int with_bits = 0;
        for (int i = 0; i < 3000; ++i) {
            Trace const trace = near_a_center();
            Window const window = windows_of(trace, config.window_length)[0];
            Match const expected = scan_search->match(window);
            ASSERT_EQ(exact_search->match(window), expected) << threshold;
            with_bits += expected.found() && expected.squared_distance > 2;
            if (i % 3 > 0) continue;
            scan->add(window);
            exact->add(window);
        }
        EXPECT_GT(with_bits, 100);
    }
}

TEST(ExactIndex, equals_the_scan_where_thousands_of_features_share_their_bits) {
    // A robot that sees nothing: only the continuous channels tell its windows apart.
    KnowledgeConfig const config = test::config_of();
    LivesShown lives{6, 4, 4000};
    for (std::vector<Trace>* traces : {&lives.known, &lives.asked})
        for (Trace& trace : *traces)
            std::fill(trace.channel_bits.begin(), trace.channel_bits.end(), std::uint16_t{0x7E00});
    std::vector<Window> const known = windows_of_all(lives.known, config.window_length);
    KnowledgeBase const base = test::base_of(config, known, std::vector<double>(known.size(), 1.0));
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    for (Window const& window : known) {
        scan->add(window);
        exact->add(window);
    }
    auto const final = make_final_exact_index(base);
    auto const scan_search = scan->search(), exact_search = exact->search(), final_search = final->search();
    for (Window const& window : windows_of_all(lives.asked, config.window_length)) {
        Match const expected = scan_search->match(window);
        ASSERT_EQ(exact_search->match(window), expected);
        ASSERT_EQ(final_search->match(window), expected);
    }
}

TEST(ExactIndex, equals_the_scan_on_ten_thousand_windows_of_robots_that_evolved) {
    // Lineages without selection: founders, and after each a line of mutants. Their windows repeat and resemble each
    // other as those of a run do.
    CollectballWorld const world{load_arena("collectball", "source")};
    KnowledgeConfig const config = test::config_of();
    EpisodeConfig episode;
    episode.steps = 2000;
    std::vector<Trace> traces;
    for (std::uint32_t line = 0; line < 8; ++line) {
        Genome genome = founder(Interface{config.channels}, Stream{41, Purpose::founder, 0, line});
        for (std::uint32_t age = 0; age < 15; ++age) {
            traces.push_back(record_episode(world, compile(genome), episode));
            Stream rng{41, Purpose::mutation, age, line};
            mutate(genome, {}, {}, rng);
        }
    }
    std::vector<Window> const windows = windows_of_all(traces, config.window_length);
    ASSERT_GE(windows.size(), 10'000u);
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    auto const scan_search = scan->search(), exact_search = exact->search();
    std::size_t differences = 0, found = 0;
    for (Window const& window : windows) {   // as the builder does
        Match const expected = scan_search->match(window);
        differences += !(exact_search->match(window) == expected);
        found += expected.found();
        if (!expected.found()) {
            scan->add(window);
            exact->add(window);
        }
    }
    EXPECT_EQ(differences, 0u);
    EXPECT_GT(found, 1000u);
    EXPECT_LT(found, windows.size() - 500);
}

TEST(ExactIndex, takes_queries_beyond_the_range_of_sensors) {
    KnowledgeConfig const config = test::config_of(1, 4.0f);
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    Trace const features = test::trace_of({{0, 0.0f}, {0, 1.0f}});
    for (Window const& window : windows_of(features, 1)) {
        scan->add(window);
        exact->add(window);
    }
    Trace const queries = test::trace_of({{0, -1.0f}, {0, -0.2f}, {0, 1.3f}, {0, 2.5f}, {0, 1e30f}, {0, -1e30f}});
    for (Window const& window : windows_of(queries, 1))
        EXPECT_EQ(exact->search()->match(window), scan->search()->match(window));
}

TEST(ExactIndex, reports_no_feature_that_is_worth_less_than_asked_for_unless_it_is_the_nearest) {
    KnowledgeConfig const config = test::config_of();
    LivesShown const lives{7, 3, 2000};
    std::vector<Window> const known = windows_of_all(lives.known, config.window_length);
    Stream rng{7, Purpose::test};
    std::vector<double> worth(known.size());
    for (double& value : worth) value = rng.below(8);
    KnowledgeBase const base = test::base_of(config, known, worth);
    auto const index = make_final_exact_index(base);
    auto const search = index->search();
    int dismissed_by_bits = 0;
    for (Window const& window : windows_of_all(lives.asked, config.window_length)) {
        Match const nearest = search->match(window);
        double const least = rng.below(8);
        Match const found = search->match_above(window, least);
        bool const wanted = nearest.found() && worth[static_cast<std::size_t>(nearest.feature)] > least;
        EXPECT_TRUE(found == nearest || (!wanted && !found.found()));
        bool const possible = search->may_match_above(window.bits, least);
        EXPECT_TRUE(possible || !wanted);
        dismissed_by_bits += !possible;
    }
    EXPECT_GT(dismissed_by_bits, 0);
}
