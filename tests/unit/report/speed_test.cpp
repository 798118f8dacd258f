#include "speed.h"

#include <gmock/gmock.h>

using namespace lore;
using ::testing::ElementsAre;

namespace {

using Names = std::vector<std::string>;

Treatment treatment(std::string name, Names knowledge = {}, Names clone_of = {}, Names policy_of = {}) {
    Treatment made;
    made.name = made.label = std::move(name);
    made.config = "target.toml";
    made.knowledge = std::move(knowledge);
    made.clone_of = std::move(clone_of);
    made.policy_of = std::move(policy_of);
    return made;
}

/// Two source runs, a base of each, another derived from the first, and a policy of the first alone.
CampaignPlan plan_with_policy() {
    CampaignPlan plan;
    KnowledgePlan first, second, derived;
    first.name = "kb1";
    second.name = "kb2";
    derived.name = "credit";
    derived.kind = KnowledgeKind::revalued;
    derived.base = "kb1";
    plan.knowledge = {first, second, derived};
    plan.targets = {treatment("none"), treatment("kb1", {"kb1"}), treatment("clone", {}, {"credit"}),
                    treatment("policy", {}, {}, {"kb1"}), treatment("kb2", {"kb2"})};
    for (Treatment const& one : plan.targets) plan.report_order.push_back(one.name);
    return plan;
}

}   // namespace

TEST(Speed, times_the_first_generation_with_so_much_reward) {
    std::vector<std::vector<double>> const curves{{0, 1, 1, 3, 2}, {0, 0, 2, 2, 2}};
    SpeedRow const row = speed_of("a", curves, 4, first_reward_levels);
    EXPECT_EQ(row.runs, 2);
    EXPECT_EQ(row.generations, 4);
    EXPECT_EQ(row.to[0].reached, 2);
    EXPECT_EQ(row.to[0].mean, 1.5);   // generations 1 and 2
    EXPECT_EQ(row.to[0].median, 1.5);
    EXPECT_EQ(row.to[0].low, 1);
    EXPECT_EQ(row.to[0].high, 2);
    EXPECT_EQ(row.to[1].reached, 1);
    EXPECT_EQ(row.to[1].mean, 3.5);   // 3, and 4 for the one that never has three
    EXPECT_EQ(row.to[2].reached, 0);
    EXPECT_EQ(row.to[2].mean, 4);   // restricted to what was looked at
    EXPECT_EQ(row.to[2].high, 4);
    EXPECT_EQ(row.area, (6 + 5) / 2.0);   // 0.5 + 1 + 2 + 2.5, and 0 + 1 + 2 + 2
    EXPECT_EQ(row.area_low, 5);
    EXPECT_EQ(row.area_high, 6);
}

TEST(Speed, times_levels_and_measures_areas_below_zero) {
    std::vector<std::vector<double>> const curves{{-4, -1.5, 0.5}};
    SpeedRow const row = speed_of("a", curves, 2, std::vector<double>{-2, 0, 0.75});
    EXPECT_EQ(row.to[0].level, -2);
    EXPECT_EQ(row.to[0].mean, 1);
    EXPECT_EQ(row.to[1].mean, 2);
    EXPECT_EQ(row.to[1].reached, 1);
    EXPECT_EQ(row.to[2].reached, 0);
    EXPECT_EQ(row.area, -2.75 - 0.5);
}

TEST(Speed, has_levels_of_the_campaign_of_the_unit_or_between_the_worst_and_the_best) {
    CampaignPlan plan;
    using Levels = std::vector<double>;
    EXPECT_EQ(timed_levels(plan, "balls", Levels{2, 8}), (Levels{1, 3, 5}));
    EXPECT_EQ(timed_levels(plan, "cos", Levels{-3, -10, -6}), (Levels{-8.25, -6.5, -4.75}));
    EXPECT_EQ(timed_levels(plan, "cos", Levels{-3, -3}), Levels{}) << "there is nothing between them";
    plan.levels = {2, 4};
    EXPECT_EQ(timed_levels(plan, "balls", Levels{2, 8}), (Levels{2, 4}));
}

TEST(Speed, looks_at_no_generation_after_the_last_common_one) {
    std::vector<std::vector<double>> const curves{{0, 0, 0, 9, 9}};
    SpeedRow const row = speed_of("a", curves, 2, first_reward_levels);
    EXPECT_EQ(row.to[0].reached, 0);
    EXPECT_EQ(row.to[0].mean, 2);
    EXPECT_EQ(row.area, 0);
    SpeedRow const founders = speed_of("a", std::vector<std::vector<double>>{{1}}, 0, first_reward_levels);
    EXPECT_EQ(founders.to[0].mean, 0);
    EXPECT_EQ(founders.to[0].reached, 1);
    EXPECT_EQ(founders.area, 0);
}

TEST(Lead, is_shared_with_the_policy_of_the_same_source_run) {
    std::vector<Milestone> const milestones{{"none", 10, 1}, {"kb1", 10, 2},  {"clone", 10, 4}, {"policy", 10, 5},
                                            {"kb2", 10, 3},  {"none", 20, 2}, {"kb1", 20, 1},   {"policy", 20, 6}};
    std::vector<LeadRow> const leads = leads_of(plan_with_policy(), milestones);
    ASSERT_EQ(leads.size(), 3u);   // kb2 comes from another run, and clone has no runs at generation 20
    EXPECT_EQ(leads[0].treatment, "kb1");
    EXPECT_EQ(leads[0].policy, "policy");
    EXPECT_EQ(leads[0].none, "none");
    EXPECT_EQ(leads[0].share, 0.25);
    EXPECT_EQ(leads[1].generation, 20);
    EXPECT_EQ(leads[1].share, -0.25);
    EXPECT_EQ(leads[2].treatment, "clone");
    EXPECT_EQ(leads[2].share, 0.75);
}

TEST(Lead, of_founders_from_several_bases_is_that_of_all_their_policies_together) {
    CampaignPlan plan = plan_with_policy();
    plan.targets = {treatment("none"), treatment("both", {}, {"kb2", "credit"}), treatment("one", {}, {}, {"kb1"}),
                    treatment("policies", {}, {}, {"kb1", "kb2"})};
    plan.report_order = {"none", "both", "one", "policies"};
    auto const leads = leads_of(plan, {{"none", 10, 1}, {"both", 10, 2}, {"one", 10, 3}, {"policies", 10, 5}});
    ASSERT_EQ(leads.size(), 1u);
    EXPECT_EQ(leads[0].treatment, "both");
    EXPECT_EQ(leads[0].policy, "policies");
    EXPECT_EQ(leads[0].share, 0.25);
}

TEST(Lead, is_left_out_where_there_is_none) {
    CampaignPlan plan = plan_with_policy();
    EXPECT_TRUE(leads_of(plan, {{"none", 0, 1}, {"kb1", 0, 1}, {"policy", 0, 1}}).empty());
    EXPECT_TRUE(leads_of(plan, {{"kb1", 0, 1}, {"policy", 0, 2}}).empty());
    plan.targets[0].overrides = {"evolution.generations=500"};
    EXPECT_TRUE(leads_of(plan, {{"none", 0, 1}, {"kb1", 0, 1}, {"policy", 0, 2}}).empty());
    plan.targets[3].overrides = plan.targets[0].overrides;
    EXPECT_EQ(leads_of(plan, {{"none", 0, 1}, {"kb1", 0, 1}, {"policy", 0, 2}}).size(), 1u);
    plan.targets[0].config = "other.toml";
    EXPECT_TRUE(leads_of(plan, {{"none", 0, 1}, {"kb1", 0, 1}, {"policy", 0, 2}}).empty());
}
