#include "knowledge/traces.h"

#include <lore/knowledge/index.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

using namespace lore;

TEST(FlannIndex, finds_nothing_in_an_empty_set) {
    Trace const query = test::trace_of({{0, 0.5f}});
    EXPECT_FALSE(make_flann_index(test::config_of(1))->search()->match(windows_of(query, 1)[0]).found());
}

TEST(FlannIndex, finds_a_single_feature_and_keeps_to_the_threshold) {
    Trace const feature = test::trace_of({{0b1111, 0.5f}}), query = test::trace_of({{0, 0.5f}});
    for (float const threshold : {2.0f, 2.01f}) {
        auto const index = make_flann_index(test::config_of(1, threshold));
        index->add(windows_of(feature, 1)[0]);
        EXPECT_EQ(index->search()->match(windows_of(query, 1)[0]).found(), threshold > 2.0f);   // strict, not squared
        EXPECT_EQ(index->search()->match(windows_of(feature, 1)[0]), (Match{0, 0.0f}));
    }
}

TEST(FlannIndex, reports_only_true_matches_and_most_of_them) {
    KnowledgeConfig const config = test::config_of();
    Stream rng{21, Purpose::test};
    auto const flann = make_flann_index(config), scan = make_scan_index(config);
    std::vector<Trace> traces;
    for (int i = 0; i < 10; ++i) traces.push_back(test::lifelike_trace(rng, 4000));
    for (Trace const& trace : traces)
        for (Window const& window : windows_of(trace, config.window_length)) {
            flann->add(window);
            scan->add(window);
        }
    auto const flann_search = flann->search(), scan_search = scan->search();
    int expected = 0, found = 0;
    for (Trace& trace : traces) {
        for (float& value : trace.values) value = std::min(1.0f, value + 0.05f);
        for (Window const& window : windows_of(trace, config.window_length)) {
            Match const truth = scan_search->match(window), answer = flann_search->match(window);
            expected += truth.found();
            found += answer.found();
            if (answer.found()) {
                ASSERT_TRUE(truth.found());
                ASSERT_GE(answer.squared_distance, truth.squared_distance);
            }
        }
    }
    ASSERT_GT(expected, 100);
    double const recall = static_cast<double>(found) / expected;
    std::printf("FLANN found %d of %d matches: recall %.3f\n", found, expected, recall);
    RecordProperty("recall", std::to_string(recall));
}
