#include <lore/campaign/choice.h>

#include <lore/core/error.h>
#include <support/scratch.h>

#include <gtest/gtest.h>

#include <fstream>

using namespace lore;

namespace {

CampaignPlan wishes(std::vector<double> const& levels) {
    CampaignPlan plan;
    for (double const level : levels) {
        KnowledgePlan knowledge;
        knowledge.name = "kb" + std::to_string(plan.knowledge.size() + 1);
        knowledge.wished_balls = level;
        plan.knowledge.push_back(knowledge);
    }
    return plan;
}

std::vector<SourceRun> runs_with(std::vector<int> const& balls) {
    std::vector<SourceRun> runs;
    for (int const b : balls) runs.push_back({static_cast<int>(runs.size()) + 1, runs.size() + 1, b});
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
    // 7: runs 2 and 4, the lower seed 2. 6: 4 (7 balls), 1 and 6 (5 balls) are equally near: run 1. 5: run 6. 3: run 3.
    EXPECT_EQ(chosen(choice), (std::vector<int>{2, 1, 6, 3}));
}

TEST(Choice, gives_runs_named_by_the_campaign_first) {
    CampaignPlan plan = wishes({7, 0});
    plan.knowledge[1].run = 2;
    EXPECT_EQ(choose_runs(plan, runs_with({4, 7, 6}), {}).of("kb1").run, 3);
}

TEST(Choice, keeps_what_was_chosen_before) {
    Choice const before = choose_runs(wishes({7}), runs_with({4, 6}), {});
    Choice const after = choose_runs(wishes({7, 7}), runs_with({4, 6, 7}), {}, before);
    EXPECT_EQ(after.of("kb1").run, 2);
    EXPECT_EQ(after.of("kb2").run, 3);
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
    EXPECT_EQ(read.of("kb2").balls, 6);
    EXPECT_EQ(read.considered.size(), 3u);
    EXPECT_EQ(read.without, std::vector<int>{9});
}

TEST(Choice, refuses_a_damaged_record) {
    Scratch const scratch;
    std::ofstream{scratch.file("choice.json")} << "{\"chosen\": [{}]}";
    EXPECT_THROW(read_choice(scratch.file("choice.json")), Error);
}
