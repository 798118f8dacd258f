#include "knowledge/traces.h"

#include <lore/core/error.h>
#include <lore/knowledge/builder.h>
#include <lore/knowledge/derive.h>
#include <lore/knowledge/shaping.h>

#include <gtest/gtest.h>

#include <thread>

using namespace lore;
using lore::test::base_of;
using lore::test::trace_of;

TEST(Shaper, gives_the_largest_value_among_the_matched_features) {
    Shaper const shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}, {0x1E0, 0.5f}}, {2.0, 5.0, 7.0})};
    Trace const trace = trace_of({{0x000, 0.5f}, {0x01E, 0.5f}, {0x001, 0.5f}});
    EXPECT_EQ(shaper.shaping(windows_of(trace, 1)), 5.0);
    EXPECT_EQ(shaper.highest_value(), 7.0);
}

TEST(Shaper, gives_minus_one_where_no_window_matches) {
    Shaper const shaper{base_of({{0x000, 0.5f}}, {2.0})};
    Trace const trace = trace_of({{0x0FF, 0.5f}});
    EXPECT_EQ(shaper.shaping(windows_of(trace, 1)), no_feature_value);
    EXPECT_EQ(shaper.shaping({}), no_feature_value);
    EXPECT_EQ(Shaper{base_of({}, {})}.shaping(windows_of(trace, 1)), no_feature_value);
}

TEST(Shaper, takes_negative_values_as_any_others_by_rule_max) {
    Shaper const shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}, {0x1E0, 0.5f}}, {-3.0, -1.0, -5.0})};
    EXPECT_EQ(shaper.highest_value(), -1.0);
    EXPECT_EQ(shaper.nothing_shown(), -6.0);
    auto const shaping_of = [&](std::initializer_list<test::Step> steps) {
        Trace const trace = trace_of(steps);
        return shaper.shaping(windows_of(trace, 1));
    };
    EXPECT_EQ(shaping_of({{0x1E0, 0.5f}}), -5.0);
    EXPECT_EQ(shaping_of({{0x1E0, 0.5f}, {0x000, 0.5f}}), -3.0);
    EXPECT_EQ(shaping_of({{0x1E0, 0.5f}, {0x01F, 0.5f}}), -1.0);
    EXPECT_EQ(shaping_of({{0x0AA, 0.5f}}), -6.0) << "below all who show something";
    EXPECT_TRUE(shaper.reader().may_matter(std::vector<std::uint16_t>{0x1E0}, {}));
}

TEST(Shaper, gives_minus_one_for_nothing_as_long_as_every_value_is_larger) {
    EXPECT_EQ(Shaper{base_of({{0x000, 0.5f}}, {0.0})}.nothing_shown(), -1.0);
    EXPECT_EQ((Shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}}, {2.0, -0.5})}.nothing_shown()), -1.0);
    EXPECT_EQ((Shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}}, {-1.0, 2.0})}.nothing_shown()), -2.0);
    for (auto const& values : {std::vector{-1.0, -1.5}, std::vector{-1.5, -1.0}})
        EXPECT_EQ((Shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}}, values)}.nothing_shown()), -2.5);
}

TEST(Shaper, adds_every_showing_by_rule_sum_and_every_feature_once_by_rule_distinct) {
    KnowledgeBase const base = base_of({{0x000, 0.5f}, {0x01F, 0.5f}, {0x1E0, 0.5f}}, {2.0, -5.0, 7.0});
    Trace const trace = trace_of({{0x01F, 0.5f}, {0x000, 0.5f}, {0x001, 0.5f}, {0x0AA, 0.5f}});
    EXPECT_EQ((Shaper{base, ShapingRule::sum}.shaping(windows_of(trace, 1))), -5.0 + 2.0 + 2.0);
    EXPECT_EQ((Shaper{base, ShapingRule::distinct}.shaping(windows_of(trace, 1))), 2.0 - 5.0);
    EXPECT_EQ((Shaper{base, ShapingRule::sum}.shaping({})), 0.0) << "nobody shows anything worth something";
}

TEST(Shaper, counts_a_window_shown_several_times_so_often_by_rule_sum_alone) {
    KnowledgeBase const base = base_of({{0x000, 0.5f}}, {2.0});
    Trace const trace = trace_of({{0x000, 0.5f}});
    for (auto const& [rule, expected] :
         {std::pair{ShapingRule::sum, 6.0}, std::pair{ShapingRule::distinct, 2.0}, std::pair{ShapingRule::max, 2.0}}) {
        Shaper const shaper{base, rule};
        auto reader = shaper.reader();
        ShapingState state;
        reader.see(windows_of(trace, 1)[0], state, 3);
        EXPECT_EQ(reader.value(state), expected) << name(rule);
    }
}

TEST(Shaper, lists_the_features_shown_for_rule_share_which_needs_the_pool) {
    Shaper const shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}, {0x1E0, 0.5f}}, {2.0, 5.0, 7.0}), ShapingRule::share};
    Trace const trace = trace_of({{0x1E0, 0.5f}, {0x000, 0.5f}, {0x1E0, 0.5f}});
    auto reader = shaper.reader();
    ShapingState state;
    for (Window const& window : windows_of(trace, 1)) reader.see(window, state);
    EXPECT_EQ(reader.value(state), no_feature_value);
    EXPECT_EQ(state.shown, (std::vector<std::uint32_t>{0, 2}));
}

TEST(Shaper, passes_over_windows_whose_bits_match_nothing) {
    Shaper const shaper{base_of({{0x000, 0.5f}}, {-3.0}), ShapingRule::sum};
    auto reader = shaper.reader();
    std::vector<std::uint16_t> const near{0x001}, far{0x0FF};
    EXPECT_TRUE(reader.may_matter(near, {})) << "negative values count too";
    EXPECT_FALSE(reader.may_matter(far, {}));
}

TEST(Shaper, knows_its_rules_by_name) {
    for (ShapingRule const rule : {ShapingRule::max, ShapingRule::distinct, ShapingRule::sum, ShapingRule::share})
        EXPECT_EQ(shaping_rule(name(rule)), rule);
    EXPECT_THROW(shaping_rule("most"), UsageError);
}

TEST(Shaper, counts_the_nearest_feature_of_a_window_though_another_within_the_threshold_is_worth_more) {
    // The query is at squared distance 1 from the first and 2 from the second feature, both within 1.83.
    Shaper const shaper{base_of({{0b001, 0.5f}, {0b110, 0.5f}}, {1.0, 9.0})};
    Trace const trace = trace_of({{0b000, 0.5f}});
    EXPECT_EQ(shaper.shaping(windows_of(trace, 1)), 1.0);
    ShapingState state;
    state.best = 0.5;
    shaper.reader().see(windows_of(trace, 1)[0], state);
    EXPECT_EQ(state.best, 1.0);
}

TEST(Shaper, equals_the_definition_on_lifelike_traces_in_every_order_of_asking) {
    KnowledgeConfig const config = test::config_of();
    KnowledgeBuilder builder{config, make_scan_index(config)};
    Stream rng{3, Purpose::test};
    for (int i = 0; i < 12; ++i) {
        Trace const trace = test::lifelike_trace(rng, 2000);
        builder.add_individual({windows_of(trace, config.window_length), static_cast<double>(rng.below(8))});
    }
    KnowledgeBase const drawn = randomize(std::move(builder).finish({}), 5);
    std::vector<double> values{drawn.values().begin(), drawn.values().end()};
    for (double& value : values) value -= 4;   // about half of them negative
    KnowledgeBase const base = drawn.with_values(std::move(values), {});
    Shaper const shaper{base};
    auto const scan = make_scan_index(config);
    for (int i = 0; i < base.size(); ++i) scan->add(base.window(i));
    auto const search = scan->search();
    for (int i = 0; i < 40; ++i) {
        Stream again =
            i % 2 == 0 ? rng : Stream{3, Purpose::test};   // new traces, and one that the base was built from
        Trace const trace = test::lifelike_trace(again, 2000);
        rng.bits();
        std::vector<Window> const windows = windows_of(trace, config.window_length);
        double expected = shaper.nothing_shown();
        for (Window const& window : windows)
            if (Match const m = search->match(window); m.found()) expected = std::max(expected, base.value(m.feature));
        EXPECT_EQ(shaper.shaping(windows), expected);
    }
}

TEST(Shaper, answers_several_threads_alike) {
    KnowledgeConfig const config = test::config_of();
    KnowledgeBuilder builder{config, make_scan_index(config)};
    Stream rng{4, Purpose::test};
    for (int i = 0; i < 6; ++i) {
        Trace const trace = test::lifelike_trace(rng, 2000);
        builder.add_individual({windows_of(trace, config.window_length), static_cast<double>(i)});
    }
    Shaper const shaper{std::move(builder).finish({})};
    Trace const query = test::lifelike_trace(rng, 2000);
    std::vector<Window> const windows = windows_of(query, config.window_length);
    double const expected = shaper.shaping(windows);
    std::vector<double> got(4, -2);
    std::vector<std::thread> threads;
    for (double& result : got)
        threads.emplace_back([&] {
            for (int k = 0; k < 5; ++k) result = shaper.shaping(windows);
        });
    for (std::thread& thread : threads) thread.join();
    for (double const result : got) EXPECT_EQ(result, expected);
}
