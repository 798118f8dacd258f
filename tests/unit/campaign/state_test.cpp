#include <lore/campaign/state.h>

#include "campaign_fixture.h"

#include <lore/archive/file_lock.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

class State : public test::CampaignTest {};

TEST_F(State, of_everything_is_missing_at_first) {
    for (Step const& step : steps_of(plan()))
        EXPECT_EQ(state_of(plan(), directory(), step).status, StepStatus::missing) << step.name;
}

TEST_F(State, of_a_missing_step_says_what_it_waits_for) {
    for (auto const& [step, state] : states_of(plan(), directory())) {
        bool const waits = step.kind != StepKind::evolve || step.subject == "kb1" || step.subject == "all";
        EXPECT_EQ(state.reason.starts_with("waits for "), waits) << step.name << ": " << state.reason;
        if (step.name == "kb1/001") { EXPECT_EQ(state.reason, "waits for knowledge/kb1"); }
        if (!waits) { EXPECT_EQ(state.reason, "not started"); }
    }
}

TEST_F(State, of_a_run_made_with_other_settings_is_failed_and_says_which) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("source/001").status, StepStatus::done);
    std::string text = test::small_campaign;
    text.replace(text.find("generations = 20"), 16, "generations = 30");
    write("campaign.toml", text);
    EXPECT_EQ(state("source/001").status, StepStatus::failed);
    EXPECT_NE(state("source/001").reason.find("evolution.generations"), std::string::npos)
        << state("source/001").reason;
}

TEST_F(State, of_a_finished_run_goes_on_when_the_plan_asks_for_more_generations) {
    std::string text = test::small_campaign;
    text.replace(text.find("runs = 4"), 8, "runs = 4\ngenerations = 20");
    write("campaign.toml", text);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    std::string const short_progress = read(directory().run("kb1/001") + "/progress.csv");
    text.replace(text.find("generations = 20"), 16, "generations = 30");
    write("campaign.toml", text);
    EXPECT_EQ(state("source/001").status, StepStatus::done);
    EXPECT_EQ(state("kb1/001").status, StepStatus::interrupted);
    EXPECT_EQ(state("kb1/001").reason, "at generation 20 of 30");
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("kb1/001").status, StepStatus::done);
    EXPECT_EQ(state("kb1/001").generation, 30);
    EXPECT_TRUE(read(directory().run("kb1/001") + "/progress.csv").starts_with(short_progress));

    text.replace(text.find("generations = 30"), 16, "generations = 10");
    write("campaign.toml", text);
    EXPECT_THAT(state("kb1/001").reason, HasSubstr("evolution.generations = 30, not 10")) << "not undone";
}

TEST_F(State, of_a_run_that_would_go_on_is_failed_if_another_setting_differs) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    std::string text = test::small_campaign;
    text.replace(text.find("generations = 20"), 16, "generations = 30");
    text.replace(text.find("label = \"no transfer\""), 21, "set = [\"evolution.population=100\"]");
    write("campaign.toml", text);
    EXPECT_EQ(state("none/001").status, StepStatus::failed);
    EXPECT_THAT(state("none/001").reason, HasSubstr("evolution.population"));
    EXPECT_EQ(state("none/001").reason.find("generations"), std::string::npos) << state("none/001").reason;
}

TEST_F(State, of_a_run_made_with_another_base_or_other_founders_is_failed_and_says_which) {
    std::string const given = "knowledge = \"kb1_all\"";
    auto const give = [&](std::string const& key) {
        std::string text = test::small_campaign;
        write("campaign.toml", text.replace(text.find(given), given.size(), key));
    };
    auto const expect = [&](std::string const& key, std::string const& words) {
        give(key);
        StepState const now = state("all/001");
        if (words.empty()) EXPECT_EQ(now.status, StepStatus::done) << key << ": " << now.reason;
        else EXPECT_NE(now.reason.find(words), std::string::npos) << key << ": " << now.reason;
    };
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    expect(given, "");
    expect("", "it was made with " + directory().knowledge("kb1_all") + " as knowledge base: move ");
    expect("knowledge = \"kb1\"", "kb1_all.lorekb, not with knowledge = kb1: move ");
    expect("clone_of = \"kb1_all\"", "kb1_all.lorekb as knowledge base: move ");
    for (std::string const key : {"clone_of", "policy_of"}) {
        give(key + " = \"kb1\"");
        std::filesystem::remove_all(directory().run("all"));
        ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
        expect(key + " = \"kb1\"", "");
        for (std::string const other : {"clone_of", "policy_of"})
            expect(other + " = \"kb2\"", "not with " + other + " = kb2: move ");
        expect(given, "it was made without knowledge = kb1_all: move ");
        expect("", " as founders: move ");
        expect("set = [\"founders.from=elsewhere.lore\"]", "");
    }
    std::filesystem::remove(directory().choice());
    expect("policy_of = \"kb1\"", "");
}

TEST_F(State, of_a_run_with_founders_from_other_bases_or_in_another_order_is_failed) {
    std::string const given = "knowledge = \"kb1_all\"";
    auto const reason_with = [&](std::string const& key) {
        std::string text = test::small_campaign;
        write("campaign.toml", text.replace(text.find(given), given.size(), key));
        return state("all/001").reason;
    };
    reason_with("clone_of = [\"kb1\", \"kb2\"]");
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("all/001").status, StepStatus::done) << state("all/001").reason;
    EXPECT_THAT(reason_with("clone_of = [\"kb2\", \"kb1\"]"), HasSubstr("kb1.lorekb, not with clone_of = kb2: move "));
    EXPECT_THAT(reason_with("clone_of = \"kb1\""), HasSubstr("it was made not with clone_of = kb1: move "));
    EXPECT_THAT(reason_with("clone_of = [\"kb1\", \"kb2\", \"kb1_all\"]"),
                HasSubstr("it was made not with clone_of = kb1, kb2, kb1_all: move "));
}

TEST_F(State, of_a_run_with_another_seed_is_failed) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    std::string text = test::small_campaign;
    text.replace(text.find("runs = 3"), 8, "runs = 3\nfirst_seed = 5");
    write("campaign.toml", text);
    EXPECT_NE(state("none/001").reason.find("seed 1, not 5"), std::string::npos);
}

TEST_F(State, of_a_step_whose_lock_is_held_is_running) {
    auto lock = FileLock::take(directory().lock("none/001"));
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FileLock::take(directory().lock("none/001"))) << "one at a time";
    EXPECT_EQ(state("none/001").status, StepStatus::running);
    lock.reset();
    EXPECT_EQ(state("none/001").status, StepStatus::missing);
}

TEST_F(State, of_a_run_with_a_damaged_manifest_is_failed) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write("c/runs/none/001/manifest.json", "{");
    EXPECT_EQ(state("none/001").status, StepStatus::failed);
}

TEST_F(State, of_a_run_without_its_configuration_is_failed) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    std::filesystem::remove(directory().run("none/001") + "/config.toml");
    EXPECT_EQ(state("none/001").status, StepStatus::failed);
    EXPECT_THAT(state("none/001").reason, HasSubstr("config.toml"));
}

TEST_F(State, of_a_run_whose_progress_was_cut_is_failed_and_says_where_it_ends) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    std::string const progress = read(directory().run("none/001") + "/progress.csv");
    write("c/runs/none/001/progress.csv", progress.substr(0, progress.find("\n13,") + 1));
    EXPECT_EQ(state("none/001").status, StepStatus::failed);
    EXPECT_THAT(state("none/001").reason, HasSubstr("progress.csv was cut, it ends at generation 12 of 20"));
}

TEST_F(State, of_a_choice_that_the_campaign_no_longer_makes_is_failed_and_says_which) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("choose").status, StepStatus::done);
    std::string text = test::small_campaign;
    text.replace(text.find("balls = 6"), 9, "balls = 5");
    write("campaign.toml", text);
    EXPECT_EQ(state("choose").status, StepStatus::failed);
    EXPECT_THAT(state("choose").reason, HasSubstr("'kb1' comes from run "));
}

TEST_F(State, of_an_archive_is_what_it_was_while_its_run_is_made_again) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ChosenRun const origin = recorded_choice(directory(), "source")->of("kb1");
    std::filesystem::remove_all(directory().run(run_step("source", origin.run)));
    EXPECT_EQ(state("archive/kb1_all").status, StepStatus::done);
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("archive/kb1_all").status, StepStatus::done);
}

TEST_F(State, of_an_archive_with_another_signature_than_its_run_is_failed) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("archive/kb1_all").status, StepStatus::done);
    std::string const path = directory().run("archive/kb1_all") + "/manifest.json";
    std::string text = read(path);
    text.replace(text.find("00000000"), 8, "11111111");
    write("c/runs/archive/kb1_all/manifest.json", text);
    EXPECT_EQ(state("archive/kb1_all").status, StepStatus::failed);
}

TEST_F(State, keeps_failures_with_the_end_of_their_log) {
    Step const step = steps_of(plan()).front();
    std::filesystem::create_directories(scratch.file("c/steps"));
    write_failure(directory(), step, {2, "exit code 1", {"first \xff line", "last line"}});
    auto const failure = read_failure(directory(), step);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->attempts, 2);
    EXPECT_EQ(failure->log_tail.back(), "last line");
    EXPECT_EQ(state("source/001").status, StepStatus::failed);
    EXPECT_NE(state("source/001").reason.find("exit code 1 after 2 attempts: last line"), std::string::npos);
    clear_failure(directory(), step);
    EXPECT_FALSE(read_failure(directory(), step));
}

TEST_F(State, reads_only_whole_lines_of_progress) {
    std::filesystem::create_directories(scratch.file("r"));
    EXPECT_EQ(last_progress(scratch.file("r")).generation, 0);
    write("r/progress.csv", "generation,best_balls,seconds\n");
    EXPECT_EQ(last_progress(scratch.file("r")).generation, 0);
    write("r/progress.csv", "generation,best_balls,seconds\n11,2,0.5\n12,3,0.75\n13,4,0.8");
    EXPECT_EQ(last_progress(scratch.file("r")).generation, 12);
    EXPECT_EQ(last_progress(scratch.file("r")).best_reward, 3);
    EXPECT_EQ(last_progress(scratch.file("r")).seconds, 0.75);
}
