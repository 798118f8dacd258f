#include "knowledge/traces.h"
#include "support/scratch.h"

#include <lore/core/error.h>
#include <lore/knowledge/index.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace lore;
using lore::test::trace_of;

namespace {

/// Windows of one step with one binary channel pattern and one level each, as features.
std::unique_ptr<GrowingIndex> index_of(std::unique_ptr<GrowingIndex> index, Trace const& trace, int window_length) {
    for (Window const& window : windows_of(trace, window_length)) index->add(window);
    return index;
}

std::unique_ptr<GrowingIndex> exact_index(KnowledgeConfig const& config) { return make_exact_index(config); }

Match match(FeatureIndex const& index, Window const& window) { return index.search()->match(window); }

}   // namespace

class EveryExactIndex : public testing::TestWithParam<std::unique_ptr<GrowingIndex> (*)(KnowledgeConfig const&)> {};
INSTANTIATE_TEST_SUITE_P(, EveryExactIndex, testing::Values(make_scan_index, exact_index));

TEST_P(EveryExactIndex, finds_nothing_in_an_empty_set) {
    auto const index = GetParam()(test::config_of(1));
    Trace const query = trace_of({{0, 0.5f}});
    Match const found = match(*index, windows_of(query, 1)[0]);
    EXPECT_FALSE(found.found());
    EXPECT_EQ(found.squared_distance, std::numeric_limits<float>::infinity());
}

TEST_P(EveryExactIndex, matches_strictly_below_the_threshold_only) {
    // One step; the bits differ by 4, so the distance is exactly 2.
    Trace const feature = trace_of({{0b1111, 0.5f}}), query = trace_of({{0, 0.5f}});
    Window const window = windows_of(query, 1)[0];
    EXPECT_FALSE(match(*index_of(GetParam()(test::config_of(1, 2.0f)), feature, 1), window).found());
    float const above = std::nextafter(2.0f, 3.0f);
    Match const found = match(*index_of(GetParam()(test::config_of(1, above)), feature, 1), window);
    EXPECT_EQ(found, (Match{0, 4.0f}));
}

TEST_P(EveryExactIndex, takes_the_threshold_as_a_distance_not_a_square) {
    // Six continuous differences of 0.5 and one bit: squared distance 2.5, distance 1.58.
    Trace const feature = trace_of({{1, 0.5f}}), query = trace_of({{0, 0.0f}});
    EXPECT_TRUE(match(*index_of(GetParam()(test::config_of(1)), feature, 1), windows_of(query, 1)[0]).found());
    EXPECT_FALSE(match(*index_of(GetParam()(test::config_of(1, 1.5f)), feature, 1), windows_of(query, 1)[0]).found());
}

TEST_P(EveryExactIndex, prefers_the_nearer_feature_and_among_equals_the_first) {
    Trace const features = trace_of({{0, 0.75f}, {0, 0.25f}, {0, 0.25f}, {1, 0.5f}});
    Trace const queries = trace_of({{0, 0.25f}, {0, 0.5f}, {1, 0.5f}});
    auto const index = index_of(GetParam()(test::config_of(1)), features, 1);
    std::vector<Window> const windows = windows_of(queries, 1);
    EXPECT_EQ(match(*index, windows[0]), (Match{1, 0.0f}));          // not 2, its double
    EXPECT_EQ(match(*index, windows[1]), (Match{0, 6 * 0.0625f}));   // 0 and 1 are equally far
    EXPECT_EQ(match(*index, windows[2]), (Match{3, 0.0f}));
}

TEST_P(EveryExactIndex, sees_features_that_were_added_after_a_search_began) {
    auto const index = GetParam()(test::config_of(1));
    auto const search = index->search();
    Trace const query = trace_of({{3, 0.5f}}), far = trace_of({{3, 0.0f}}), near = trace_of({{1, 0.5f}});
    Window const window = windows_of(query, 1)[0];
    EXPECT_FALSE(search->match(window).found());
    index->add(windows_of(far, 1)[0]);
    EXPECT_EQ(search->match(window), (Match{0, 1.5f}));
    index->add(windows_of(near, 1)[0]);
    EXPECT_EQ(search->match(window), (Match{1, 1.0f}));
}

TEST(IndexKind, is_known_by_name) {
    EXPECT_EQ(index_kind("exact"), IndexKind::exact);
    EXPECT_EQ(index_kind(name(IndexKind::flann)), IndexKind::flann);
    EXPECT_THROW(index_kind("kdtree"), UsageError);
}

TEST(IndexChoice, names_the_checks_of_flann_where_they_are_unusual) {
    EXPECT_EQ(text(IndexKind::exact), "exact");
    EXPECT_EQ(text(IndexKind::flann), "flann");
    EXPECT_EQ(text(IndexChoice{IndexKind::flann, 64}), "flann with 64 checks");
}

TEST_P(EveryExactIndex, takes_up_each_window_with_the_nearest_of_those_that_were_there_in_its_turn) {
    // Squared distances are differing bits; less than 3.35 of them match. 0 is there, so 0b111 matches it, until
    // 0b1111, which becomes a feature, is nearer; 0b11 is as near to the one as to the other, and matches the older
    // one.
    Trace const known = trace_of({{0, 0.5f}});
    Trace const batch = trace_of({{0b111, 0.5f},
                                  {0b1111, 0.5f},
                                  {0b111, 0.5f},
                                  {0b11, 0.5f},
                                  {0b1111, 0.5f},
                                  {0b111000000, 0.5f},
                                  {0b111110000, 0.5f},
                                  {0b111000000, 0.5f}});
    for (int const threads : {1, 2, 5}) {
        auto const index = index_of(GetParam()(test::config_of(1)), known, 1);
        Crew crew{threads};
        EXPECT_EQ(index->take_up(windows_of(batch, 1), crew), (std::vector<int>{0, 1, 1, 0, 1, 0, 2, 2}));
        EXPECT_EQ(index->size(), 3);
        EXPECT_EQ(match(*index, windows_of(batch, 1)[6]), (Match{2, 0.0f}));
    }
}

TEST(ExactIndex, keeps_windows_in_a_folder_and_answers_as_if_they_were_in_memory) {
    Scratch const scratch;
    KnowledgeConfig const config = test::config_of();
    Stream rng{81, Purpose::test};
    std::vector<Trace> traces;
    for (int i = 0; i < 12; ++i) traces.push_back(test::lifelike_trace(rng, 2000));
    auto const in_memory = make_exact_index(config), in_folder = make_exact_index(config, scratch.path());
    Crew crew{2};
    for (Trace const& trace : traces) {
        std::vector<Window> const windows = windows_of(trace, config.window_length);
        ASSERT_EQ(in_folder->take_up(windows, crew), in_memory->take_up(windows, crew));
        for (Window const& window : windows)
            ASSERT_EQ(in_folder->search()->match(window), in_memory->search()->match(window));
    }
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
    WindowArrays const from_folder = in_folder->release(), from_memory = in_memory->release();
    EXPECT_GT(from_memory.values.size(), 100u * 120u);
    EXPECT_TRUE(std::ranges::equal(from_folder.values, from_memory.values));
    EXPECT_TRUE(std::ranges::equal(from_folder.bits, from_memory.bits));
}
