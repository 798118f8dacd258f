#include <lore/campaign/choice.h>

#include <lore/core/error.h>
#include <support/scratch.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

using namespace lore;

namespace {

CampaignPlan wishes(std::vector<double> const& levels) {
    CampaignPlan plan;
    for (double const level : levels) {
        KnowledgePlan knowledge;
        knowledge.name = "kb" + std::to_string(plan.knowledge.size() + 1);
        knowledge.wished_reward = level;
        plan.knowledge.push_back(knowledge);
    }
    return plan;
}

std::vector<SourceRun> runs_with(std::vector<double> const& rewards) {
    std::vector<SourceRun> runs;
    for (double const reward : rewards) runs.push_back({static_cast<int>(runs.size()) + 1, runs.size() + 1, reward});
    return runs;
}

std::vector<int> chosen(Choice const& choice) {
    std::vector<int> runs;
    for (ChosenRun const& entry : choice.chosen) runs.push_back(entry.run);
    return runs;
}

}   // namespace

TEST(Choice, takes_the_nearest_level_not_yet_taken_and_the_lowest_seed_among_equals) {
    //                                 run    1  2  3  4  5  6
    Choice const choice = choose_runs(wishes({7, 6, 5, 3}), runs_with({5, 7, 3, 7, 4, 5}), {});
    // 7: runs 2 and 4, the lower seed 2. 6: 4 (it has 7), 1 and 6 (5) are equally near: run 1. 5: run 6. 3: run 3.
    EXPECT_EQ(chosen(choice), (std::vector<int>{2, 1, 6, 3}));
}

TEST(Choice, gives_runs_named_by_the_campaign_first) {
    CampaignPlan plan = wishes({7, 0});
    plan.knowledge[1].run = 2;
    EXPECT_EQ(choose_runs(plan, runs_with({4, 7, 6}), {}).of("kb1").run, 3);
}

TEST(Choice, takes_the_run_with_most_reward_of_its_own_source) {
    CampaignPlan plan = wishes({0, 0, 5});
    plan.knowledge[0].best_run = plan.knowledge[1].best_run = true;
    plan.knowledge[2].source = "elsewhere";
    Choice const choice = choose_runs(plan, runs_with({-4, 7, -1, 7}), {});
    EXPECT_EQ(chosen(choice), (std::vector<int>{2, 4})) << "ties: the lowest seed; the second base takes the next";
    EXPECT_TRUE(choice.covers(plan));
    Choice of_both = choice;
    of_both.source.clear();
    EXPECT_FALSE(of_both.covers(plan));
    Scratch const scratch;
    write_choice(scratch.file("choice.json"), choice);
    EXPECT_TRUE(read_choice(scratch.file("choice.json")).of("kb1").best);
}

TEST(Choice, keeps_what_was_chosen_before) {
    Choice const before = choose_runs(wishes({7}), runs_with({4, 6}), {});
    Choice const after = choose_runs(wishes({7, 7}), runs_with({4, 6, 7}), {}, before);
    EXPECT_EQ(after.of("kb1").run, 2);
    EXPECT_EQ(after.of("kb2").run, 3);
}

TEST(Choice, is_outdated_where_the_campaign_asks_for_another_run_level_or_rule) {
    CampaignPlan plan = wishes({7, 0, 0});
    plan.knowledge[1].run = 2;
    plan.knowledge[2].best_run = true;
    Choice const choice = choose_runs(plan, runs_with({7, 3, 8, 5}), {});
    EXPECT_EQ(choice.outdated(plan), nullptr);
    auto const outdated_after = [&](auto const& change) {
        CampaignPlan changed = plan;
        change(changed.knowledge);
        ChosenRun const* const old = choice.outdated(changed);
        return old == nullptr ? "" : old->knowledge;
    };
    EXPECT_EQ(outdated_after([](auto& bases) { bases[0].wished_reward = 6; }), "kb1");
    EXPECT_EQ(outdated_after([](auto& bases) { bases[0].run = 1; }), "") << "the run that it has";
    EXPECT_EQ(outdated_after([](auto& bases) { bases[1].run = 4; }), "kb2");
    EXPECT_EQ(outdated_after([](auto& bases) { bases[2].best_run = false; }), "kb3");
    EXPECT_EQ(outdated_after([](auto& bases) { bases.pop_back(); }), "") << "a base that is gone takes no run";
}

TEST(Choice, needs_a_run_for_each_knowledge_base) {
    EXPECT_THROW(choose_runs(wishes({7, 6}), runs_with({4}), {2, 3}), Error);
    CampaignPlan plan = wishes({0});
    plan.knowledge[0].run = 5;
    EXPECT_THROW(choose_runs(plan, runs_with({4, 4}), {}), Error);
}

TEST(Choice, is_recorded_and_read_back) {
    Scratch const scratch;
    Choice const choice = choose_runs(wishes({7, 6}), runs_with({4, 7, 6}), {9});
    write_choice(scratch.file("choice.json"), choice);
    Choice const read = read_choice(scratch.file("choice.json"));
    EXPECT_EQ(chosen(read), chosen(choice));
    EXPECT_EQ(read.of("kb2").reward, 6);
    EXPECT_EQ(read.considered.size(), 3u);
    EXPECT_EQ(read.without, std::vector<int>{9});
}

TEST(Choice, takes_the_nearest_of_rewards_that_are_negative_and_not_whole) {
    Choice const choice = choose_runs(wishes({-2, -100}), runs_with({-1.5, -2.25, -40.5}), {});
    EXPECT_EQ(chosen(choice), (std::vector<int>{2, 3}));
}

TEST(Choice, is_recorded_with_the_unit_that_its_rewards_have) {
    Scratch const scratch;
    auto const recorded = [&](std::string const& unit) {
        Choice choice = choose_runs(wishes({-2}), runs_with({-1.5, -2.25}), {});
        choice.reward_unit = unit;
        write_choice(scratch.file("choice.json"), choice);
        std::ifstream file{scratch.file("choice.json")};
        return std::string{std::istreambuf_iterator<char>{file}, {}};
    };
    std::string const first = recorded("balls"), other = recorded("cos");
    EXPECT_NE(first.find("\"balls\": -2.25"), std::string::npos) << first;
    EXPECT_EQ(first.find("reward"), std::string::npos);
    EXPECT_NE(other.find("\"reward\": -2.25"), std::string::npos) << other;
    Choice const read = read_choice(scratch.file("choice.json"));
    EXPECT_EQ(read.reward_unit, "cos");
    EXPECT_EQ(read.of("kb1").reward, -2.25);
}

TEST(Choice, refuses_a_damaged_record) {
    Scratch const scratch;
    std::ofstream{scratch.file("choice.json")} << "{\"chosen\": [{}]}";
    EXPECT_THROW(read_choice(scratch.file("choice.json")), Error);
}
