#include <lore/watch/watcher.h>

#include "campaign/campaign_fixture.h"
#include "support/small_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <lore/archive/file_lock.h>

#include <set>

using namespace lore;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

TEST(MeanCurve, is_over_the_runs_that_have_come_so_far) {
    EXPECT_THAT(mean_curve({{0, 2, 4}, {0, 1}}),
                ElementsAre(MeanPoint{0, 0, 2}, MeanPoint{1, 1.5, 2}, MeanPoint{2, 4, 1}));
    EXPECT_THAT(mean_curve({{3}}), ElementsAre(MeanPoint{0, 3, 1}));
    EXPECT_THAT(mean_curve({}), IsEmpty());
    EXPECT_THAT(mean_curve({{}, {}}), IsEmpty());
}

TEST(MeanCurve, has_at_most_201_points_and_the_first_and_the_last_generation) {
    for (std::size_t length = 1; length < 900; ++length) {
        auto const curve = mean_curve({std::vector<double>(length, 5)});
        ASSERT_LE(curve.size(), 201u) << length;
        ASSERT_EQ(curve.front().generation, 0);
        ASSERT_EQ(curve.back().generation, static_cast<int>(length) - 1);
        for (std::size_t i = 1; i < curve.size(); ++i)
            ASSERT_LT(curve[i - 1].generation, curve[i].generation) << length;
    }
}

class Facts : public test::CampaignTest {
protected:
    /// A run that has got these rewards by generation, in a second each.
    void write_progress(std::string const& step, std::vector<double> const& rewards) const {
        std::string const run = directory().run(step);
        fs::create_directories(run);
        std::string table = progress_header("balls") + "\n";
        for (std::size_t g = 0; g < rewards.size(); ++g) {
            GenerationSummary row;
            row.generation = static_cast<int>(g);
            row.best_reward = rewards[g];
            row.seconds = static_cast<double>(g);
            table += text(row) + "\n";
        }
        std::ofstream{run + "/progress.csv"} << table;
    }
    CampaignWatcher watcher() const { return {scratch.file("campaign.toml"), scratch.file("c")}; }
    static json document(CampaignFacts const& facts) { return json::parse(facts_json(facts)); }
    static TreatmentFacts treatment(CampaignFacts const& facts, std::string const& name) {
        for (TreatmentFacts const& one : facts.treatments)
            if (one.name == name) return one;
        return {};
    }
    /// Every path below the scratch directory, with size and time of the last change.
    std::set<std::string> everything() const {
        std::set<std::string> all;
        for (auto const& entry : fs::recursive_directory_iterator{scratch.path()})
            all.insert(entry.path().string() + ' ' + std::to_string(entry.is_regular_file() ? entry.file_size() : 0) +
                       ' ' + std::to_string(entry.last_write_time().time_since_epoch().count()));
        return all;
    }
};

TEST_F(Facts, of_a_directory_that_is_not_there_yet_are_that_it_is_waited_for) {
    CampaignFacts const facts = watcher().look();
    EXPECT_THAT(facts.notice, HasSubstr("Waiting for " + scratch.file("c")));
    EXPECT_EQ(facts.count(StepStatus::missing), static_cast<int>(facts.steps.size()));
    EXPECT_FALSE(facts.seconds_left);
    EXPECT_EQ(facts.share, 0);
    EXPECT_FALSE(fs::exists(scratch.file("c"))) << "it is not for a watcher to make it";
}

TEST_F(Facts, of_a_run_at_work_are_its_progress_and_the_time_that_is_left) {
    write_progress("none/001", {0, 2, 4});
    auto const lock = FileLock::take(directory().lock("none/001"));
    CampaignFacts const facts = watcher().look();
    EXPECT_EQ(facts.notice, "");
    TreatmentFacts const none = treatment(facts, "none");
    EXPECT_EQ(none.label, "no transfer");
    EXPECT_EQ(none.planned, 3);
    EXPECT_EQ(none.started, 1);
    EXPECT_EQ(none.running, 1);
    EXPECT_EQ(none.done, 0);
    EXPECT_EQ(none.mean_reward, 4);
    EXPECT_THAT(none.curve, ElementsAre(MeanPoint{0, 0, 1}, MeanPoint{1, 2, 1}, MeanPoint{2, 4, 1}));
    // 4 source runs, 9 target runs and the archive, 20 generations each; 2 are done, in a second each.
    EXPECT_DOUBLE_EQ(facts.share, 2. / 280);
    ASSERT_TRUE(facts.seconds_left);
    EXPECT_DOUBLE_EQ(*facts.seconds_left, 278);

    json const told = document(facts);
    EXPECT_EQ(told["title"], "A small campaign");
    EXPECT_EQ(
        told["counts"],
        json({{"done", 0}, {"running", 1}, {"interrupted", 0}, {"failed", 0}, {"missing", facts.steps.size() - 1}}));
    EXPECT_EQ(told["seconds_left"], 278);
    EXPECT_EQ(told["treatments"][0]["name"], "source") << "first";
    EXPECT_EQ(told["treatments"][0]["source"], true);
    EXPECT_FALSE(told["treatments"][1].contains("source") || told["treatments"][1].contains("target"));
    EXPECT_EQ(told["treatments"][1]["curve"], json::parse("[[0, 0.0, 1], [1, 2.0, 1], [2, 4.0, 1]]"));
    for (json const& step : told["steps"]) {
        if (step["name"] != "none/001") continue;
        EXPECT_EQ(step, json({{"name", "none/001"},
                              {"group", "none"},
                              {"state", "running"},
                              {"reason", "at generation 2 of 20"},
                              {"generation", 2},
                              {"generations", 20},
                              {"balls", 4},
                              {"seconds", 2.0}}));
    }
}

TEST_F(Facts, name_the_target_task_of_a_treatment_by_its_label_too) {
    write("campaign.toml", "title = \"Two tasks\"\nruns = 2\ngenerations = 20\n"
                           "[[source]]\nname = \"easy\"\nconfig = \"source.toml\"\n"
                           "[[target]]\nname = \"hard\"\nlabel = \"the hard task\"\nconfig = \"target.toml\"\n"
                           "[transfer]\nmethod = \"shaping\"\n");
    json const treatments = document(watcher().look())["treatments"];
    ASSERT_EQ(treatments.size(), 3u);
    EXPECT_FALSE(treatments[0].contains("target_label")) << "a source task";
    EXPECT_EQ(treatments[1]["target"], "hard");
    EXPECT_EQ(treatments[1]["target_label"], "the hard task");
}

TEST_F(Facts, of_negative_rewards_name_the_greatest_with_its_unit) {
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    CampaignFacts const facts = watcher().look();
    TreatmentFacts const none = treatment(facts, "none");
    EXPECT_LT(none.best_reward, 0);
    EXPECT_LE(none.mean_reward, none.best_reward);
    EXPECT_EQ(none.reward_unit, "cos");
    json const told = document(facts);
    EXPECT_EQ(told["treatments"][1]["best_reward"], none.best_reward);
    EXPECT_EQ(told["champions"][0]["reward_unit"], "cos");
    EXPECT_FALSE(told["champions"][0].contains("balls"));
}

TEST_F(Facts, grow_with_the_run_and_shrink_when_it_is_resumed_at_a_checkpoint) {
    CampaignWatcher watcher{scratch.file("campaign.toml"), scratch.file("c")};
    write_progress("none/001", {0, 1});
    EXPECT_EQ(treatment(watcher.look(), "none").curve.size(), 2u);
    write_progress("none/001", {0, 1, 1, 3});
    write_progress("none/002", {0});
    EXPECT_EQ(treatment(watcher.look(), "none").curve.size(), 4u);
    EXPECT_EQ(treatment(watcher.look(), "none").started, 2);
    EXPECT_EQ(treatment(watcher.look(), "none").mean_reward, 1.5);
    write_progress("none/001", {0, 1, 1});
    EXPECT_EQ(treatment(watcher.look(), "none").curve.size(), 3u);
    fs::remove_all(scratch.file("c"));
    CampaignFacts const gone = watcher.look();
    EXPECT_THAT(gone.notice, HasSubstr("Waiting for"));
    EXPECT_THAT(treatment(gone, "none").curve, IsEmpty());
}

TEST_F(Facts, of_a_finished_campaign_name_the_best_runs_and_leave_no_time) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    CampaignFacts const facts = watcher().look();
    EXPECT_EQ(facts.count(StepStatus::done), static_cast<int>(facts.steps.size()));
    EXPECT_EQ(facts.share, 1);
    EXPECT_FALSE(facts.seconds_left);
    ASSERT_EQ(facts.champions.size(), 2u);
    EXPECT_THAT(facts.champions[0].run, HasSubstr("source/"));
    EXPECT_EQ(facts.champions[0].reward, treatment(facts, "source").best_reward);
    EXPECT_THAT(facts.champions[1].problem, HasSubstr("lineage.lore")) << "the fake program leaves no lineage";
    EXPECT_EQ(document(facts)["seconds_left"], json());
    EXPECT_THAT(watcher().replays(), IsEmpty());
}

TEST_F(Facts, have_the_best_robot_step_by_step) {
    test::write_small_run(directory().run("source/001"));
    fs::copy_file(directory().run("source/001") + "/config.toml", scratch.file("small.toml"));
    std::string text = test::small_campaign;
    text.replace(text.find("source.toml"), 11, "small.toml");
    text.replace(text.find("generations = 20"), 16, "generations = 6");
    write("campaign.toml", text);
    CampaignWatcher watcher{scratch.file("campaign.toml"), scratch.file("c")};
    CampaignFacts const facts = watcher.look();
    ASSERT_EQ(facts.champions.size(), 1u) << state("source/001").reason;
    EXPECT_EQ(facts.champions[0].problem, "");
    ASSERT_EQ(watcher.replays().size(), 1u);
    EXPECT_EQ(watcher.replays()[0].steps.size(), 400u);
}

TEST_F(Facts, of_failures_have_the_end_of_their_log_whatever_it_holds) {
    fs::create_directories(scratch.file("c/steps"));
    Step const step = steps_of(plan()).front();
    write_failure(directory(), step, {2, "exit code 1", {"<script>alert(1)</script>", "\xff \x1b[31m \"quoted\""}});
    CampaignFacts const facts = watcher().look();
    ASSERT_EQ(facts.failures.size(), 1u);
    EXPECT_EQ(facts.failures[0].step, "source/001");
    EXPECT_EQ(facts.failures[0].log, scratch.file("c/logs/source-001.log"));
    json const told = document(facts)["failures"][0];
    EXPECT_EQ(told["tail"][0], "<script>alert(1)</script>") << "the page shows it as text";
    EXPECT_EQ(told["tail"][1], "\xef\xbf\xbd \x1b[31m \"quoted\"");
    EXPECT_THAT(facts_json(facts), HasSubstr("\\u001b[31m"));
}

TEST_F(Facts, are_at_most_fifty_failures) {
    std::string text = test::small_campaign;
    text.replace(text.find("runs = 3"), 8, "runs = 60");
    write("campaign.toml", text);
    fs::create_directories(scratch.file("c/steps"));
    for (Step const& step : steps_named(steps_of(plan()), {"none"}))
        write_failure(directory(), step, {2, "signal 9", {}});
    CampaignFacts const facts = watcher().look();
    EXPECT_EQ(facts.count(StepStatus::failed), 60);
    EXPECT_EQ(facts.failures.size(), 50u);
}

TEST_F(Facts, stay_when_the_campaign_file_is_spoiled_and_come_back_when_it_is_mended) {
    CampaignWatcher watcher{scratch.file("campaign.toml"), scratch.file("c")};
    write_progress("none/001", {0, 2});
    std::size_t const steps = watcher.look().steps.size();
    write("campaign.toml", "title = \"Spoiled\"\nrunning = 3\n");
    CampaignFacts const spoiled = watcher.look();
    EXPECT_THAT(spoiled.notice, HasSubstr("campaign.toml"));
    EXPECT_EQ(spoiled.steps.size(), steps);
    EXPECT_EQ(treatment(spoiled, "none").started, 1);
    std::string text = test::small_campaign;
    text.replace(text.find("runs = 3"), 8, "runs = 5");
    write("campaign.toml", text);
    CampaignFacts const mended = watcher.look();
    EXPECT_EQ(mended.notice, "");
    EXPECT_EQ(mended.steps.size(), steps + 6) << "two more runs of three treatments";
}

TEST_F(Facts, of_damaged_files_are_the_reason_not_an_end) {
    CampaignWatcher watcher{scratch.file("campaign.toml"), scratch.file("c")};
    write_progress("none/001", {0, 2});
    write("c/runs/none/001/manifest.json", "{");
    EXPECT_EQ(watcher.look().failures.size(), 1u);
    fs::create_directories(scratch.file("c/knowledge"));
    write("c/knowledge/choice.json", "{");
    EXPECT_THAT(watcher.look().notice, HasSubstr("choice.json"));
    fs::remove(scratch.file("c/knowledge/choice.json"));
    EXPECT_EQ(watcher.look().notice, "");
}

TEST_F(Facts, are_read_without_a_trace) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    fs::create_directories(scratch.file("c/steps"));
    write_failure(directory(), steps_named(steps_of(plan()), {"none/001"}).front(), {1, "signal 9", {"a line"}});
    auto const before = everything();
    CampaignWatcher watcher{scratch.file("campaign.toml"), scratch.file("c")};
    watcher.look();
    watcher.look();
    EXPECT_EQ(before, everything());
}
