#include "knowledge/layouts.h"
#include "knowledge/traces.h"

#include <lore/core/isa.h>
#include <lore/knowledge/builder.h>
#include <lore/knowledge/index.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace lore;
using lore::test::Layout;

namespace {

/// One kind alone, one channel of a kind, the edges of a step's words and of a summary's numbers, and all there may be.
std::vector<Layout> const layouts{{0, 1},  {0, 3}, {0, 4}, {0, 6},  {0, 7},  {0, 8},   {0, 12}, {0, 13}, {0, 33},
                                  {0, 80}, {1, 0}, {9, 0}, {16, 0}, {17, 0}, {80, 0},  {1, 1},  {2, 8},  {1, 40},
                                  {40, 1}, {9, 6}, {9, 8}, {16, 4}, {12, 8}, {30, 20}, {40, 40}};

/// Features and questions: what some lives show, and the same with changes of every size.
struct Asked {
    std::vector<Trace> known, asked;
    Asked(Channels const& channels, std::uint32_t slot, int traces, int steps) {
        Stream rng{61, Purpose::test, 0, slot};
        for (int i = 0; i < traces; ++i) {
            known.push_back(test::wandering_trace(channels, rng, steps));
            asked.push_back(known.back());
            for (double const change : {0.002, 0.02, 0.2}) asked.push_back(test::changed(known.back(), rng, change));
            asked.push_back(test::wandering_trace(channels, rng, steps));
        }
    }
};

std::vector<Window> all_windows(std::vector<Trace> const& traces, int window_length) {
    std::vector<Window> windows;
    for (Trace const& trace : traces)
        for (Window const& window : windows_of(trace, window_length)) windows.push_back(window);
    return windows;
}

/// Asks a final index for features worth more than something, and compares with what the scan has found.
void expect_worth(FeatureSearch& search, std::span<double const> worth, Window const& window, Match const& nearest,
                  double least) {
    bool const wanted = nearest.found() && worth[static_cast<std::size_t>(nearest.feature)] > least;
    Match const found = search.match_above(window, least);
    EXPECT_TRUE(found == nearest || (!wanted && !found.found()));
    EXPECT_TRUE(search.may_match_above(window.bits, least) || !wanted);
}

void expect_agreement(KnowledgeConfig const& config, std::uint32_t slot) {
    Asked const lives{config.channels, slot, 2, 20 * config.window_length + 50};
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    auto const scan_search = scan->search(), exact_search = exact->search();
    std::vector<Window> const known = all_windows(lives.known, config.window_length),
                              asked = all_windows(lives.asked, config.window_length);
    std::vector<Window> features;
    for (Window const& window : known) {   // while the set grows
        Match const expected = scan_search->match(window);
        ASSERT_EQ(exact_search->match(window), expected);
        if (expected.found()) continue;
        features.push_back(window);
        scan->add(window);
        exact->add(window);
    }
    std::vector<Match> expected;
    for (Window const& window : asked) {
        expected.push_back(scan_search->match(window));
        ASSERT_EQ(exact_search->match(window), expected.back());
    }
    Stream rng{62, Purpose::test, 0, slot};
    std::vector<double> worth(features.size());
    for (double& value : worth) value = rng.below(5);
    KnowledgeBase const base = test::base_of(config, features, worth);
    auto const final = make_final_exact_index(base);
    EXPECT_EQ(final->size(), base.size());
    auto const final_search = final->search();
    for (int round = 0; round < 2; ++round)   // patterns are remembered
        for (std::size_t i = 0; i < asked.size(); ++i) {
            ASSERT_EQ(final_search->match(asked[i]), expected[i]);
            expect_worth(*final_search, worth, asked[i], expected[i], static_cast<double>(rng.below(6)) - 1);
        }
}

}   // namespace

class EveryLayout : public testing::TestWithParam<Layout> {};
INSTANTIATE_TEST_SUITE_P(, EveryLayout, testing::ValuesIn(layouts), [](auto const& tested) {
    return std::to_string(tested.param.binary) + "_binary_" + std::to_string(tested.param.continuous) + "_continuous";
});

TEST_P(EveryLayout, gives_the_matches_of_the_scan) {
    std::uint32_t slot = 0;
    Stream rng{63, Purpose::test};
    for (int const length : {1, 7, 20})
        for (float const threshold : {0.5f, 1.83f, 4.0f})
            expect_agreement({length, threshold, test::channels_of(GetParam(), rng)}, slot++);
}

TEST_P(EveryLayout, gives_the_matches_of_the_scan_on_every_instruction_set) {
    Isa const before = active_isa();
    Stream rng{64, Purpose::test};
    for (Isa const isa : {Isa::baseline, Isa::v3, Isa::v4}) {
        if (isa > detected_isa()) continue;
        use_isa(isa);
        expect_agreement({20, 1.83f, test::channels_of(GetParam(), rng)}, 100);
    }
    use_isa(before);
}

TEST_P(EveryLayout, finds_what_lies_just_inside_the_threshold_where_the_bounds_are_tight) {
    // The same difference in every value of some channels and steps is what sums of them tell in full.
    Stream rng{65, Purpose::test};
    KnowledgeConfig const config{20, 1.83f, test::channels_of(GetParam(), rng)};
    int const continuous = GetParam().continuous;
    Trace feature = test::blank_trace(config.channels, 20);
    std::vector<Window> const features = windows_of(feature, 20);
    KnowledgeBase const base = test::base_of(config, features, {1});
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    auto const final = make_final_exact_index(base);
    scan->add(features[0]);
    exact->add(features[0]);
    auto const scan_search = scan->search(), exact_search = exact->search(), final_search = final->search();
    for (int channels = 1; channels <= continuous; channels += 1 + channels / 3)
        for (int const steps : {1, 2, 3, 5, 10, 20})
            for (float const share : {0.999f, 0.99999f, 1.0f, 1.00001f}) {
                float const level =
                    std::sqrt(config.squared_threshold() / static_cast<float>(channels * steps)) * share;
                if (level > 1) continue;
                Trace query = feature;
                for (int step = 0; step < steps; ++step)
                    std::fill_n(query.values.begin() + step * continuous, channels, level);
                Window const window = windows_of(query, 20)[0];
                Match const expected = scan_search->match(window);
                ASSERT_EQ(exact_search->match(window), expected);
                ASSERT_EQ(final_search->match(window), expected);
            }
}

TEST(ExactIndex, equals_the_scan_on_random_layouts) {
    Stream rng{66, Purpose::test};
    for (std::uint32_t round = 0; round < 40; ++round) {
        Layout const layout{static_cast<int>(rng.below(41)), static_cast<int>(rng.below(41))};
        if (layout.binary + layout.continuous == 0) continue;
        int const length = 1 + static_cast<int>(rng.below(25));
        auto const threshold = static_cast<float>(rng.uniform(0.3, 5));
        SCOPED_TRACE(testing::Message() << layout.binary << " binary and " << layout.continuous << " continuous, "
                                        << length << " steps, threshold " << threshold);
        expect_agreement({length, threshold, test::channels_of(layout, rng)}, 200 + round);
    }
}

TEST(ExactIndex, equals_the_scan_where_thousands_of_features_have_no_bits) {
    Stream rng{67, Purpose::test};
    KnowledgeConfig const config{5, 0.4f, test::channels_of({0, 4}, rng)};
    Asked const lives{config.channels, 300, 4, 5000};
    std::vector<Window> const known = all_windows(lives.known, config.window_length),
                              asked = all_windows(lives.asked, config.window_length);
    ASSERT_GE(known.size(), 4000u);
    std::vector<double> worth;
    for (std::size_t i = 0; i < known.size(); ++i) worth.push_back(rng.below(100));
    KnowledgeBase const base = test::base_of(config, known, worth);
    auto const scan = make_scan_index(config), exact = make_exact_index(config);
    auto const final = make_final_exact_index(base);
    for (Window const& window : known) {
        scan->add(window);
        exact->add(window);
    }
    auto const scan_search = scan->search(), exact_search = exact->search(), final_search = final->search();
    for (std::size_t i = 0; i < asked.size(); i += 7) {
        Match const expected = scan_search->match(asked[i]);
        ASSERT_EQ(exact_search->match(asked[i]), expected);
        ASSERT_EQ(final_search->match(asked[i]), expected);
        expect_worth(*final_search, worth, asked[i], expected, rng.below(100));
    }
}

TEST(KnowledgeBuilder, gives_the_same_base_by_scan_and_by_the_exact_index_whatever_the_channels) {
    Stream rng{68, Purpose::test};
    for (Layout const& layout : {Layout{0, 8}, Layout{20, 0}, Layout{17, 5}}) {
        KnowledgeConfig const config{10, 1.0f, test::channels_of(layout, rng)};
        Asked const lives{config.channels, 400, 2, 400};
        KnowledgeBuilder plain{config, make_scan_index(config)}, fast{config, make_exact_index(config)};
        std::vector<Exhibit> exhibits;
        for (Trace const& trace : lives.asked)
            exhibits.push_back({windows_of(trace, config.window_length), rng.uniform(-1, 1)});
        for (Exhibit const& exhibit : exhibits) plain.add_individual(exhibit);
        Crew crew{2};
        fast.add_individuals(exhibits, crew);
        KnowledgeBase const expected = std::move(plain).finish({}), base = std::move(fast).finish({});
        ASSERT_EQ(base.size(), expected.size());
        EXPECT_TRUE(std::ranges::equal(base.parts().bits, expected.parts().bits));
        EXPECT_TRUE(std::ranges::equal(base.parts().windows, expected.parts().windows));
        EXPECT_TRUE(std::ranges::equal(base.values(), expected.values()));
    }
}
