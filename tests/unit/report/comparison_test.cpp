#include "comparison.h"
#include "findings.h"
#include "page_parts.h"
#include "summary.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace lore;

namespace {

CampaignPlan three_treatments() {
    CampaignPlan plan;
    plan.title = "three";
    plan.sources.emplace_back().name = "source";
    plan.sources.front().runs = 0;
    for (char const* name : {"a", "b", "c"}) {
        Treatment treatment;
        treatment.name = treatment.label = name;
        treatment.runs = 3;
        plan.targets.push_back(treatment);
        plan.report_order.push_back(name);
    }
    return plan;
}

Results results_with(std::vector<std::pair<std::string, std::vector<double>>> const& rewards) {
    Results results;
    for (auto const& [treatment, values] : rewards)
        for (double const value : values) results.runs.push_back({treatment, 1, 1, value, 0, 0, "", ""});
    return results;
}

}   // namespace

TEST(Comparison, pairs_treatments_that_have_runs_in_the_order_of_the_report) {
    auto const comparisons = compare_treatments(three_treatments(), results_with({{"a", {1, 2, 3}}, {"c", {4, 5, 6}}}));
    ASSERT_EQ(comparisons.size(), 1u);
    EXPECT_EQ(comparisons[0].a, "a");
    EXPECT_EQ(comparisons[0].b, "c");
    EXPECT_EQ(comparisons[0].u, 0);
    EXPECT_NEAR(comparisons[0].p, 0.1, 1e-15);
    EXPECT_EQ(comparisons[0].a12, 0);
    EXPECT_TRUE(comparisons[0].exact);
}

TEST(Comparison, corrects_for_all_pairs) {
    auto const comparisons =
        compare_treatments(three_treatments(), results_with({{"a", {1, 2, 3}}, {"b", {4, 5, 6}}, {"c", {7, 8, 9}}}));
    ASSERT_EQ(comparisons.size(), 3u);
    for (Comparison const& c : comparisons) EXPECT_NEAR(c.p_holm, 0.3, 1e-12);
}

TEST(Comparison, writes_the_promised_columns) {
    auto const comparisons = compare_treatments(three_treatments(), results_with({{"a", {1, 1}}, {"b", {1, 1}}}));
    EXPECT_EQ(comparisons_csv(comparisons), "a,b,n_a,n_b,u,p,p_holm,a12\na,b,2,2,2,1,1,0.5\n");
}

TEST(Comparison, is_not_shown_where_it_was_not_made) {
    CampaignPlan plan = three_treatments();
    Treatment fourth = plan.targets.front();
    fourth.name = fourth.label = "d";
    plan.targets.push_back(fourth);
    plan.report_order.push_back("d");
    Results results = results_with({{"a", {1, 2}}, {"b", {3, 4}}, {"c", {5, 6}}, {"d", {7, 8}}});
    for (RunRow& run : results.runs)
        if (run.treatment >= "c") run.reward_unit = "cos";
    std::string const square = p_value_square(plan, compare_treatments(plan, results));
    EXPECT_NE(square.find(">a</th><td>1</td><td>0.333</td><td>-</td><td>-</td>"), std::string::npos) << square;
}

TEST(Pools, take_runs_together_and_correct_for_their_planned_comparisons_alone) {
    CampaignPlan plan = three_treatments();
    plan.pools.push_back({"ab", "a and b", {"a", "b"}, {"c"}});
    Results const results = results_with({{"a", {1, 2}}, {"b", {3}}, {"c", {4, 5, 6}}});
    EXPECT_EQ(rewards_of(plan, results, "ab"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(rewards_of(plan, results, "c"), (std::vector<double>{4, 5, 6}));
    auto const planned = compare_pools(plan, results);
    ASSERT_EQ(planned.size(), 1u);
    EXPECT_EQ(planned[0].n_a, 3);
    EXPECT_NEAR(planned[0].p, 0.1, 1e-15);
    EXPECT_NEAR(planned[0].p_holm, 0.1, 1e-15) << "one comparison needs no correction, whatever the pairs are";
    EXPECT_EQ(pools_csv(planned).substr(0, 60), "a,b,n_a,n_b,u,p,p_holm,a12,a12_low,a12_high\nab,c,3,3,0,0.1,0");
}

TEST(Pools, are_compared_with_pools_before_them_and_corrected_together) {
    CampaignPlan plan = three_treatments();
    plan.pools.push_back({"first", "", {"a"}, {"c"}});
    plan.pools.push_back({"second", "", {"b"}, {"c", "first"}});
    auto const planned = compare_pools(plan, results_with({{"a", {1, 2, 3}}, {"b", {4, 5, 6}}, {"c", {7, 8, 9}}}));
    ASSERT_EQ(planned.size(), 3u);
    EXPECT_EQ(planned[2].a, "second");
    EXPECT_EQ(planned[2].b, "first");
    for (Comparison const& c : planned) EXPECT_NEAR(c.p_holm, 0.3, 1e-12);
}

TEST(Pools, without_runs_are_compared_with_nothing) {
    CampaignPlan plan = three_treatments();
    plan.pools.push_back({"ab", "", {"a", "b"}, {"c"}});
    EXPECT_TRUE(compare_pools(plan, results_with({{"c", {1, 2}}})).empty());
}

TEST(Comparison, gives_the_papers_marks) {
    EXPECT_EQ(significance_mark(0.0009), "**");
    EXPECT_EQ(significance_mark(0.001), "*");
    EXPECT_EQ(significance_mark(0.01), "");
}

TEST(Summary, says_how_complete_the_campaign_is) {
    CampaignPlan const plan = three_treatments();
    Results const results = results_with({{"a", {1, 2, 3}}, {"b", {4, 5}}});
    auto const document = nlohmann::json::parse(summary_json(plan, results, findings_of(plan, results)));
    EXPECT_EQ(document["complete"], false);
    EXPECT_EQ(document["treatments"][1]["mean"], 2.0);
    EXPECT_EQ(document["treatments"][2]["runs"], 2);
    EXPECT_EQ(document["treatments"][3]["runs"], 0);
    EXPECT_FALSE(document["treatments"][3].contains("mean"));
}
