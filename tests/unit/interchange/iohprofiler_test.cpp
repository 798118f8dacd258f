#include <lore/interchange/iohprofiler.h>

#include "campaign/campaign_fixture.h"
#include "support/complaint.h"

#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/world/reward_text.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace lore;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

/// A campaign of fake programs, with some tables of generations written by hand.
class Iohprofiler : public test::CampaignTest {
protected:
    Iohprofiler() {
        write("campaign.toml", "title = \"C\"\nruns = 2\ngenerations = 4\n[source]\nconfig = \"source.toml\"\n"
                               "[[treatment]]\nname = \"none\"\nlabel = \"no \\\"transfer\\\"\"\n"
                               "config = \"target.toml\"\n");
        EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    }
    /// 400 founders, then 200 evaluations a generation.
    void write_rewards(std::string const& step, std::vector<double> const& rewards,
                       std::string_view unit = first_reward_unit) const {
        std::string table = progress_header(unit) + "\n";
        for (std::size_t g = 0; g < rewards.size(); ++g) {
            GenerationSummary row;
            row.generation = static_cast<int>(g);
            row.best_reward = rewards[g];
            row.mean_reward = rewards[g] - 2.75;
            row.evaluations = 400 + 200 * g;
            table += text(row) + "\n";
        }
        std::ofstream{directory().run(step) + "/progress.csv"} << table;
    }
};

TEST_F(Iohprofiler, gets_the_evaluations_at_which_a_run_improved_and_its_last) {
    write_rewards("none/001", {0, 0, 1, 1, 3});
    write_rewards("none/002", {2, 1, 2, 1, 1});   // survivors may lose the best
    ExportCounts const counts = export_iohprofiler(plan(), directory(), scratch.file("ioh"));
    EXPECT_EQ(counts.treatments, 2);
    EXPECT_EQ(counts.runs, 4);
    EXPECT_EQ(read(scratch.file("ioh/none/data_f2_target/IOHprofiler_f2_DIM1.dat")), "evaluations raw_y\n"
                                                                                     "1 0\n"
                                                                                     "800 1\n"
                                                                                     "1200 3\n"
                                                                                     "evaluations raw_y\n"
                                                                                     "1 0\n"
                                                                                     "400 2\n"
                                                                                     "1200 1\n");
    json const about = json::parse(read(scratch.file("ioh/none/IOHprofiler_f2_target.json")));
    EXPECT_EQ(about.at("algorithm"), json({{"name", "none"}, {"info", "no \"transfer\""}}));
    EXPECT_EQ(about.at("maximization"), true);
    EXPECT_EQ(about.at("attributes"), json({"evaluations", "raw_y"}));
    json const& runs = about.at("scenarios").at(0).at("runs");
    EXPECT_EQ(runs.at(0), json({{"instance", 1},
                                {"evals", 1200},
                                {"best", {{"evals", 1200}, {"y", 3}, {"x", json::array()}}},
                                {"seed", 1}}));
    EXPECT_EQ(runs.at(1).at("best").at("evals"), 400);
    EXPECT_EQ(runs.at(1).at("best").at("y"), 2);
}

TEST_F(Iohprofiler, gets_rewards_of_any_unit_and_no_least_one_that_a_world_does_not_have) {
    fs::remove_all(directory().path());
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    write_rewards("none/001", {-9.5, -9.5, -8.25, -8.25, -8.25}, "cos");
    export_iohprofiler(plan(), directory(), scratch.file("ioh"));
    // The fakes make the worlds of both tasks up, and they are the same.
    EXPECT_THAT(read(scratch.file("ioh/none/data_f1_toy/IOHprofiler_f1_DIM1.dat")),
                StartsWith("evaluations raw_y\n1 -12.25\n400 -9.5\n800 -8.25\n1200 -8.25\nevaluations"));
    json const about = json::parse(read(scratch.file("ioh/none/IOHprofiler_f1_toy.json")));
    EXPECT_EQ(about.at("scenarios").at(0).at("runs").at(0).at("best").at("y"), -8.25);
}

TEST_F(Iohprofiler, gets_a_function_for_each_problem_and_finished_runs_alone) {
    write("campaign.toml", read(scratch.file("campaign.toml")) +
                               "[[treatment]]\nname = \"short\"\nconfig = \"target.toml\"\nruns = 1\n"
                               "set = [\"episode.steps=500\"]\n");
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    fs::remove_all(directory().run("none/002"));
    EXPECT_EQ(export_iohprofiler(plan(), directory(), scratch.file("ioh")).runs, 4);
    EXPECT_TRUE(fs::exists(scratch.file("ioh/source/IOHprofiler_f1_source.json")));
    EXPECT_TRUE(fs::exists(scratch.file("ioh/none/IOHprofiler_f2_target.json")));
    EXPECT_TRUE(fs::exists(scratch.file("ioh/short/IOHprofiler_f3_target_3.json")));
}

TEST_F(Iohprofiler, never_writes_over_a_directory_or_leaves_half_of_one) {
    fs::create_directories(scratch.file("ioh"));
    EXPECT_THAT(test::complaint_of<UsageError>([&] { export_iohprofiler(plan(), directory(), scratch.file("ioh/")); }),
                HasSubstr("it exists"));
    EXPECT_THAT(
        test::complaint_of<UsageError>([&] { export_iohprofiler(plan(), directory("nothing"), scratch.file("ioh2")); }),
        HasSubstr("no run is finished"));
    for (auto const& entry : fs::directory_iterator{scratch.path()})
        EXPECT_FALSE(entry.path().filename().string().starts_with("ioh2")) << entry.path();
}

TEST_F(Iohprofiler, has_no_record_of_a_finished_run_whose_table_was_cut) {
    write_rewards("none/001", {});
    EXPECT_EQ(export_iohprofiler(plan(), directory(), scratch.file("ioh")).runs, 3);
}
