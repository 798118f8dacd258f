#include <lore/watch/text_view.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

StepWithState run_at(std::string name, StepStatus status, int generation, std::string reason = "") {
    Step step;
    step.name = std::move(name);
    step.group = step.subject = "none";
    StepState state;
    state.status = status;
    state.reason = std::move(reason);
    state.generation = generation;
    state.generations = 20;
    state.best_reward = 1;
    state.reward_unit = "balls";
    state.seconds = 60.0 * generation;
    return {step, state};
}

CampaignFacts facts() {
    CampaignFacts facts;
    facts.title = "A title\033[2J";
    facts.time = "2025-01-31T12:00:00Z";
    facts.steps = {run_at("none/001", StepStatus::done, 20), run_at("none/002", StepStatus::running, 10),
                   run_at("none/003", StepStatus::failed, 0, "exit code 1\nafter")};
    TreatmentFacts none;
    none.name = "none";
    none.planned = 3;
    none.started = 2;
    none.done = none.failed = 1;
    none.mean_reward = none.best_reward = 1;
    none.reward_unit = "balls";
    facts.treatments = {none};
    facts.failures = {{"none/003", "exit code 1", "logs/none-003.log", {"it said\007 this"}}};
    facts.share = 0.5;
    facts.seconds_left = 1800;
    return facts;
}

}   // namespace

TEST(TextView, is_a_picture_with_the_campaign_in_the_last_line) {
    EXPECT_THAT(picture_of(facts()),
                ElementsAre("A title?[2J",
                            "  none                      1 of 3    done  mean 1.00, best 1 ball  1 failed",
                            "  none/002               [##########..........]     10/20  best 1 ball  10:00 left",
                            "  none/003 failed: exit code 1", "      logs/none-003.log", "      it said? this",
                            "[#####.....] 1 of 3 steps done, 1 running, 1 failed, about 30:00 left"));
}

TEST(TextView, has_a_column_as_wide_as_the_longest_name) {
    CampaignFacts named = facts();
    named.steps[1].step.name = "maze_hard_from_maze_medium/002";
    std::vector<std::string> const lines = picture_of(named);
    EXPECT_THAT(lines[1], HasSubstr("  none                              1 of 3    done"));
    EXPECT_THAT(lines[2], HasSubstr("  maze_hard_from_maze_medium/002 [####"));
}

TEST(TextView, has_rewards_of_any_unit) {
    CampaignFacts other = facts();
    other.treatments[0].mean_reward = -130.25;
    other.treatments[0].best_reward = -123.4375;
    other.treatments[0].reward_unit = "cos";
    EXPECT_EQ(picture_of(other)[1],
              "  none                      1 of 3    done  mean -130.2, best -123.4 cos  1 failed");
}

TEST(TextView, has_a_line_for_every_change) {
    CampaignFacts const before;
    EXPECT_THAT(changes_between(before, facts()),
                ElementsAre("2025-01-31T12:00:00Z none/001 done", "2025-01-31T12:00:00Z none/002 running",
                            "2025-01-31T12:00:00Z none/003 failed: exit code 1?after"));
    EXPECT_THAT(changes_between(facts(), facts()), IsEmpty());
    CampaignFacts later = facts();
    later.steps[1].state.status = StepStatus::done;
    later.steps[1].state.reason = "2 balls";
    later.notice = "Waiting for c";
    EXPECT_THAT(changes_between(facts(), later),
                ElementsAre("2025-01-31T12:00:00Z Waiting for c", "2025-01-31T12:00:00Z none/002 done: 2 balls"));
}
