#include "chart.h"

#include <gtest/gtest.h>

#include <set>

using namespace lore;

namespace {

CampaignPlan two_treatments() {
    CampaignPlan plan;
    plan.sources.emplace_back().name = "source";
    for (char const* name : {"none", "kb1"}) {
        Treatment treatment;
        treatment.name = name;
        treatment.label = std::string{name} + " <&>";
        plan.targets.push_back(treatment);
        plan.report_order.push_back(name);
    }
    return plan;
}

int occurrences(std::string const& text, std::string const& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}   // namespace

TEST(Boxplots, draw_every_run_as_a_point_and_mark_what_differs) {
    Results results;
    for (int i = 0; i < 12; ++i) {
        results.runs.push_back({"none", i, 1, 1.0 * (i % 3), 0, 0, "", ""});
        results.runs.push_back({"kb1", i, 1, 5.0 + i % 3, 0, 0, "", ""});
    }
    CampaignPlan const plan = two_treatments();
    auto const comparisons = compare_treatments(plan, results);
    ASSERT_LT(comparisons.at(0).p, 1e-3);
    std::string const svg = draw_boxplots(plan, results, comparisons);
    EXPECT_EQ(occurrences(svg, "<circle"), 24);
    EXPECT_EQ(occurrences(svg, ">**</text>"), 1);
    EXPECT_EQ(occurrences(svg, "none &lt;&amp;&gt;"), 1) << "labels are text, not markup";
}

TEST(Boxplots, stack_brackets_so_that_none_overlap) {
    CampaignPlan plan;
    Results results;
    for (int t = 0; t < 4; ++t) {
        Treatment treatment;
        treatment.name = treatment.label = "t" + std::to_string(t);
        plan.targets.push_back(treatment);
        plan.report_order.push_back(treatment.name);
        for (int i = 0; i < 10; ++i) results.runs.push_back({treatment.name, i, 1, 10.0 * t + i % 3, 0, 0, "", ""});
    }
    auto const comparisons = compare_treatments(plan, results);
    ASSERT_EQ(comparisons.size(), 6u);   // all differ: neighbors share a level, the others need three more
    std::string const svg = draw_boxplots(plan, results, comparisons);
    EXPECT_EQ(occurrences(svg, ">**</text>"), 6);
    std::set<std::string> marks;
    for (std::size_t at = svg.find(">**</text>"); at != std::string::npos; at = svg.find(">**</text>", at + 1)) {
        std::size_t const start = svg.rfind("<text", at);
        EXPECT_TRUE(marks.insert(svg.substr(start, svg.find(" font-size", start) - start)).second)
            << "two marks at one place";
    }
}

/// Runs of a world whose reward is a cost.
Results costs() {
    Results results;
    for (int i = 0; i < 6; ++i)
        for (char const* name : {"none", "kb1"})
            results.runs.push_back({name, i, 1, -123.5 + i * (name[0] == 'k' ? 0.5 : 1.5), 0, 0, "", "", "cos"});
    for (int g = 0; g <= 100; g += 10)
        results.curves.push_back({"kb1", g, 3, 0.5 * g - 123, 0.5 * g - 125, 0.5 * g - 121});
    return results;
}

/// All heights in the document are within it.
void expect_inside(std::string const& svg) {
    double const height = std::stod(svg.substr(svg.find("height=\"") + 8));
    for (char const* key : {" y1=\"", " cy=\"", " y=\""})
        for (std::size_t at = svg.find(key); at != std::string::npos; at = svg.find(key, at + 1)) {
            double const y = std::stod(svg.substr(at + std::string_view{key}.size()));
            EXPECT_GE(y, 0) << key;
            EXPECT_LE(y, height) << key;
        }
}

TEST(Boxplots, have_an_axis_for_negative_rewards_and_their_unit) {
    std::string const svg = draw_boxplots(two_treatments(), costs(), {});
    EXPECT_EQ(occurrences(svg, "reward [cos] (best-of-run)"), 1);
    EXPECT_EQ(occurrences(svg, ">-120</text>"), 1);
    EXPECT_EQ(occurrences(svg, ">0</text>"), 0);
    EXPECT_EQ(occurrences(svg, "<circle"), 12);
    expect_inside(svg);
}

TEST(Curves, have_an_axis_for_negative_rewards_and_leave_out_a_source_of_another_unit) {
    Results results = costs();
    results.runs.push_back({"source", 1, 1, 7, 0, 0, "", ""});
    results.curves.push_back({"source", 0, 3, 7, 7, 7});
    std::string const svg = draw_curves(two_treatments(), results);
    EXPECT_EQ(occurrences(svg, "reward [cos] (mean of best-of-runs)"), 1);
    EXPECT_EQ(occurrences(svg, ">-100</text>"), 1);
    EXPECT_EQ(occurrences(svg, "<polygon"), 1);
    expect_inside(svg);
}

TEST(Boxplots, mark_nothing_where_nothing_differs) {
    Results results;
    for (char const* name : {"none", "kb1"})
        for (int i = 0; i < 5; ++i) results.runs.push_back({name, i, 1, 3, 0, 0, "", ""});
    CampaignPlan const plan = two_treatments();
    EXPECT_EQ(occurrences(draw_boxplots(plan, results, compare_treatments(plan, results)), "*</text>"), 0);
}

TEST(Curves, draw_a_line_and_a_band_for_each_treatment_with_runs) {
    Results results;
    for (int g = 0; g <= 100; g += 10) results.curves.push_back({"kb1", g, 3, 0.05 * g, 0.04 * g, 0.06 * g});
    std::string const svg = draw_curves(two_treatments(), results);
    EXPECT_EQ(occurrences(svg, "<polygon"), 1);
    EXPECT_EQ(occurrences(svg, "(n = 3)"), 1);
    EXPECT_EQ(occurrences(svg, "none"), occurrences(svg, "fill=\"none\""));
}

TEST(Curves, end_with_the_runs_on_the_target_task_however_long_source_runs_are) {
    Results results;
    for (int g = 0; g <= 1000; g += 10) results.curves.push_back({"source", g, 3, 0.005 * g, 0.004 * g, 0.006 * g});
    EXPECT_EQ(occurrences(draw_curves(two_treatments(), results), ">1000</text>"), 1);
    for (int g = 0; g <= 100; g += 10) results.curves.push_back({"kb1", g, 3, 0.05 * g, 0.04 * g, 0.06 * g});
    std::string const svg = draw_curves(two_treatments(), results);
    EXPECT_EQ(occurrences(svg, ">1000</text>"), 0);
    EXPECT_EQ(occurrences(svg, ">100</text>"), 1);
    EXPECT_EQ(occurrences(svg, "<polygon"), 2);
}

TEST(Curves, tell_several_source_tasks_apart) {
    CampaignPlan plan = two_treatments();
    plan.sources.emplace_back().name = "another";
    Results results;
    EXPECT_EQ(drawn_sources(plan, results), 0u) << "no runs";
    for (char const* name : {"source", "another"})
        for (int g : {0, 100}) results.curves.push_back({name, g, 3, 5, 4, 6});
    EXPECT_EQ(drawn_sources(plan, results), 2u);
    std::string const svg = draw_curves(plan, results);
    for (char const* dashes : {"6 4", "2 2"})
        EXPECT_EQ(occurrences(svg, std::string{"stroke-dasharray=\""} + dashes + "\""), 2) << "the line and its key";
}

/// So many treatments with two runs each that end at rewards from 0 to 5.
std::pair<CampaignPlan, Results> many(int treatments) {
    CampaignPlan plan;
    Results results;
    for (int t = 0; t < treatments; ++t) {
        Treatment treatment;
        treatment.name = treatment.label = "t" + std::to_string(t);
        plan.targets.push_back(treatment);
        plan.report_order.push_back(treatment.name);
        double const reward = t % 6;
        for (int run = 1; run <= 2; ++run) results.runs.push_back({treatment.name, run, 1, reward, 0, 0, "", ""});
        for (int g : {0, 100}) results.curves.push_back({treatment.name, g, 2, reward, reward, reward});
    }
    return {plan, results};
}

TEST(Curves, have_a_frame_that_grows_with_the_names_and_dashes_that_tell_colors_apart) {
    auto const height = [](std::string const& svg) { return std::stod(svg.substr(svg.find("height=\"") + 8)); };
    auto const [some, of_some] = many(25);
    EXPECT_EQ(height(draw_curves(some, of_some)), 476) << "as long as the names fit";
    auto const [plan, results] = many(40);
    std::string const svg = draw_curves(plan, results);
    EXPECT_GT(height(svg), 476);
    expect_inside(svg);
    for (char const* dashes : {"6 4", "2 2", "9 3 2 3", "9 2 2 2 2 2"})
        EXPECT_GT(occurrences(svg, std::string{"stroke-dasharray=\""} + dashes + "\""), 0) << dashes;
}

TEST(Figures, make_room_for_long_labels_of_the_reward_axis_alone) {
    auto [plan, results] = many(2);
    EXPECT_EQ(occurrences(draw_boxplots(plan, results, {}), "<line x1=\"64\""), 3) << "a tick, and the axes";
    for (RunRow& run : results.runs) run.reward *= 250000;
    for (CurveRow& row : results.curves) row.mean = row.low = row.high = row.mean * 250000;
    for (std::string const& svg : {draw_boxplots(plan, results, {}), draw_curves(plan, results)}) {
        EXPECT_EQ(occurrences(svg, ">200000</text>"), 1);
        EXPECT_EQ(occurrences(svg, "<line x1=\"64\""), 0);
        EXPECT_GT(occurrences(svg, "<line x1=\"79\""), 0);
    }
}

TEST(Figures, leave_out_treatments_of_another_unit_and_name_them) {
    auto [plan, results] = many(3);
    EXPECT_TRUE(labels_of_other_units(plan, results).empty());
    for (RunRow& run : results.runs)
        if (run.treatment == "t1") run.reward_unit = "cos";
    EXPECT_EQ(occurrences(draw_boxplots(plan, results, {}), "<circle"), 4);
    EXPECT_EQ(occurrences(draw_curves(plan, results), "<polygon"), 2);
    EXPECT_EQ(labels_of_other_units(plan, results), (std::vector<std::string>{"t1"}));
}

TEST(Curves, say_so_where_there_is_nothing_to_draw) {
    EXPECT_EQ(occurrences(draw_curves(two_treatments(), Results{}), "no finished run yet"), 1);
    EXPECT_EQ(occurrences(draw_boxplots(two_treatments(), Results{}, {}), "no finished run yet"), 1);
}
