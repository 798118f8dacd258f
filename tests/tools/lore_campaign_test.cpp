#include "support/c_worlds.h"
#include "support/program.h"

#include <lore/archive/knowledge_file.h>

#include <cstdio>

using namespace lore;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

namespace {

class LoreCampaignTest : public test::ProgramTest {
protected:
    LoreCampaignTest() : ProgramTest(LORE_CAMPAIGN) {}
};

}   // namespace

TEST_F(LoreCampaignTest, compares_two_columns) {
    // Of ten ways to choose the two that rank lowest among five, one is this far to the left, and one to the right.
    write("low.csv", "1\n2\n");
    write("high.csv", " 3\r\n\n4\n5e0 \n");
    EXPECT_EQ(run("test low.csv high.csv").output, "U 0 p 0.2 A12 0\n");
    EXPECT_THAT(run("test high.csv low.csv").output, MatchesRegex("U 6 p 0\\.(2|19999999.*) A12 1\n"));
    EXPECT_EQ(run("test low.csv high.csv --interval").output, "U 0 p 0.2 A12 0 0 .. 0\n");

    // 3 beats 2, and 2 and 2 share a point: 1.5 of the 6 pairs.
    write("mixed.csv", "2\n4\n");
    write("third.csv", "1\n2\n3\n");
    EXPECT_THAT(run("test third.csv mixed.csv").output, StartsWith("U 1.5 p "));
    std::string const told = run("test third.csv mixed.csv --interval").output;
    EXPECT_THAT(told, HasSubstr(" A12 0.25 "));
    double low = -1, high = -1;
    ASSERT_EQ(std::sscanf(told.substr(told.find("0.25 ")).c_str(), "0.25 %lf .. %lf", &low, &high), 2) << told;
    EXPECT_GE(low, 0);
    EXPECT_LT(low, 0.25);
    EXPECT_GT(high, 0.25);
    EXPECT_LE(high, 1);
}

TEST_F(LoreCampaignTest, says_so_where_its_output_is_lost) {
    write("a.csv", "1\n2\n");
    for (char const* what : {"test a.csv a.csv > /dev/full", "--version > /dev/full", "--help > /dev/full"}) {
        test::Ran const ran = run(what);
        EXPECT_EQ(ran.exit_code, 1) << what;
        EXPECT_THAT(ran.errors, HasSubstr("cannot write the result to stdout")) << what;
    }
}

TEST_F(LoreCampaignTest, tells_what_a_missing_step_waits_for) {
    std::string const jobs = LORE_SOURCE_DIR "/jobs/campaigns/";
    std::string const told = run("status " + jobs + "small.toml --dir c").output;
    EXPECT_THAT(told, HasSubstr("source/001               missing      not started\n"));
    EXPECT_THAT(told, HasSubstr("choose                   missing      waits for source\n"));
    EXPECT_THAT(told, HasSubstr("kb1/001                  missing      waits for knowledge/kb1\n"));
    EXPECT_THAT(told, HasSubstr("none/001                 missing      not started\n"));
    EXPECT_THAT(run("status -q " + jobs + "small.toml --dir c").output, EndsWith(" missing\n"));
}

TEST_F(LoreCampaignTest, makes_bases_by_other_rules_of_value_and_founders_from_them) {
    std::string const small = "[evolution]\npopulation = 8\nfounders = 16\ngenerations = 6\n[episode]\nsteps = 400\n";
    write("source.toml", "task = \"source\"\n" + small);
    write("target.toml", "task = \"target\"\n" + small);
    auto const table = [](std::string const& kind, std::string const& name, std::string const& keys) {
        return "[[" + kind + "]]\nname = \"" + name + "\"\n" + keys + "\n";
    };
    std::string const target = "config = \"target.toml\"\n";
    write("c.toml", "title = \"Values\"\nruns = 1\n[source]\nconfig = \"source.toml\"\n" +
                        table("knowledge", "base", "run = 1\noptions = [\"--gammas\", \"0.8\", \"0.9\"]") +
                        table("knowledge", "all", "all_of = \"base\"") +
                        table("knowledge", "mean", "revalued_of = \"base\"\nvalue = \"mean\"") +
                        table("knowledge", "return", "revalued_of = \"base\"\nvalue = \"return\"\ngamma = 0.7") +
                        table("knowledge", "credit", "revalued_of = \"base\"\nvalue = \"credit\"") +
                        table("knowledge", "permuted", "permuted_of = \"return\"") +
                        table("treatment", "clones", target + "clone_of = \"return\"") +
                        table("treatment", "permuted", target + "clone_of = \"permuted\"") +
                        table("treatment", "share", target + "knowledge = \"return\"\nset = [\"shaping.rule=share\"]"));
    expect_done("run c.toml --dir c --jobs 1 -q");
    EXPECT_THAT(run("status -q c.toml --dir c").output, HasSubstr("12 done"));
    KnowledgeBase const base = read_knowledge_base(scratch.file("c/knowledge/base.lorekb"));
    EXPECT_EQ(base.evidence().gammas, (std::vector<double>{0.7, 0.8, 0.9}));
    EXPECT_EQ(read_knowledge_base(scratch.file("c/knowledge/return.lorekb")).provenance().value, "return 0.7");
    EXPECT_EQ(read_knowledge_base(scratch.file("c/knowledge/credit.lorekb")).provenance().value, "credit");

    std::filesystem::remove(scratch.file("c/knowledge/return.lorekb"));
    std::filesystem::copy_file(LORE_SOURCE_DIR "/tests/data/version-1/sample.lorekb",
                               scratch.file("c/knowledge/base.lorekb"),
                               std::filesystem::copy_options::overwrite_existing);
    test::Ran const without = run("run c.toml --dir c --jobs 1 -q --only knowledge/return");
    EXPECT_EQ(without.exit_code, 1);
    EXPECT_THAT(without.errors + without.output, HasSubstr("needs evidence that the base does not have"));
}

TEST_F(LoreCampaignTest, makes_the_matrix_of_transfer_between_tasks_of_two_worlds) {
    std::string const small = "[evolution]\npopulation = 8\nfounders = 16\ngenerations = 4\n[episode]\nsteps = 200\n";
    std::string const pendulum =
        "[world]\nlibrary = \"" + test::c_world("pendulum") + "\"\n[world.settings]\nlength = ";
    write("source.toml", "task = \"source\"\n" + small);
    write("target.toml", "task = \"target\"\n" + small);
    write("short.toml", pendulum + "1.0\n" + small);
    write("long.toml", pendulum + "1.5\n" + small);
    auto const task = [](std::string const& kind, std::string const& name, std::string const& config) {
        return "[[" + kind + "]]\nname = \"" + name + "\"\nconfig = \"" + config + ".toml\"\n";
    };
    write("c.toml", "title = \"Two worlds\"\nruns = 2\n" + task("source", "balls", "source") +
                        task("source", "pole", "short") + task("target", "balls", "target") +
                        task("target", "pole", "long") + "first_seed = 11\n[transfer]\nmethod = \"clone\"\ntop = 50\n" +
                        "[report]\ntrajectory = \"pole\"\nfigure5 = [\"pole_best\"]\n");
    std::string const planned = run("plan c.toml --dir c").output;
    EXPECT_THAT(planned, HasSubstr("# not run: pole with knowledge of balls (made for 12 sensors and 3 effectors"));
    EXPECT_THAT(planned, HasSubstr("choose/pole"));
    expect_done("run c.toml --dir c --jobs 1 -q");
    // 4 source runs, 2 choices, 4 bases, 8 target runs, the replay.
    EXPECT_THAT(run("status -q c.toml --dir c").output, HasSubstr("19 done"));
    write("c/figures/figure3_gone.svg", "of a task that the campaign had before");
    expect_done("report c.toml --dir c -q");
    EXPECT_FALSE(std::filesystem::exists(scratch.file("c/figures/figure3_gone.svg")));
    EXPECT_TRUE(std::filesystem::exists(scratch.file("c/figures/figure3_pole.svg")));
    std::string const matrix = content("c/matrix.csv");
    EXPECT_THAT(matrix, HasSubstr("\nballs,balls,balls_from_balls,balls_from_none,balls,4,2,2,"));
    EXPECT_THAT(matrix, HasSubstr("\npole,pole,pole_from_pole,pole_from_none,"));
    EXPECT_THAT(matrix, HasSubstr("\npole,balls,,balls_from_none,,,,,,,,,,,,,,,other channels\n"));
    std::string const replays = content("c/replay.csv");
    for (char const* shown : {"\npole/00", "\nballs_from_", "\npole_from_"}) EXPECT_THAT(replays, HasSubstr(shown));
    expect_done("export c.toml --dir c --out ioh -q");
    expect_done("pack c.toml --dir c --out c.tar.zst -q");
    expect_done("verify c.tar.zst -q");
}

TEST_F(LoreCampaignTest, refuses_transfer_between_tasks_that_it_does_not_know) {
    std::string const jobs = LORE_SOURCE_DIR "/jobs/tasks/";
    std::string const source = "title = \"t\"\n[source]\nconfig = \"" + jobs + "source.toml\"\n";
    write("c.toml", source + "[transfer]\nmethod = \"clone\"\n");
    expect_refusal("plan c.toml --dir c", 2, "there is no target task");
    write("c.toml", source + "[[target]]\nname = \"t\"\nconfig = \"" + jobs +
                        "target.toml\"\n[[treatment]]\n"
                        "name = \"a\"\ntarget = \"u\"\n");
    expect_refusal("plan c.toml --dir c", 2, "there is no 'u'");
}

TEST_F(LoreCampaignTest, refuses_time_limits_that_are_none) {
    std::string const submit =
        std::string{"submit "} + LORE_SOURCE_DIR "/jobs/campaigns/small.toml --only-write --dir never --time ";
    expect_refusal(submit + "abc", 2, "it is no time");
    expect_refusal(submit + "00:02:00", 2, "told to stop 120 s before it");
    expect_refusal(submit + "2", 2, "told to stop 120 s before it");
    for (char const* good : {"00:02:01", "3", "1-00", "1-02:03", "0-00:02:01", "UNLIMITED"})
        expect_done(std::string{"submit "} +
                    LORE_SOURCE_DIR "/jobs/campaigns/small.toml --only-write -q --dir c --time " + good);
}

TEST_F(LoreCampaignTest, takes_no_file_for_a_campaigns_directory) {
    write("a_file", "");
    for (char const* const subcommand : {"status ", "watch ", "run "})
        expect_refusal(std::string{subcommand} + LORE_SOURCE_DIR "/jobs/campaigns/small.toml --dir a_file", 2,
                       "a_file is no directory of a campaign (it is a file)");
}

TEST_F(LoreCampaignTest, says_what_is_no_sample) {
    write("good.csv", "1\n2\n");
    write("header.csv", "balls\n1\n");
    write("columns.csv", "1\n2,3\n");
    write("empty.csv", "\n");
    write("nan.csv", "1\nnan\n");
    expect_refusal("test header.csv good.csv", 2, "header.csv, line 1: 'balls' is no number");
    expect_refusal("test good.csv columns.csv", 2, "columns.csv, line 2: '2,3' is no number");
    expect_refusal("test good.csv missing.csv", 2, "cannot read missing.csv");
    expect_refusal("test good.csv empty.csv", 2, "empty.csv has no number");
    expect_refusal("test nan.csv good.csv", 2, "nan.csv, line 2");
    expect_refusal("test good.csv", 2, "B is required");
}
