// What a newcomer meets: `lore`, and mistakes in the first commands. Every message names the next step.

#include "support/program.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

using namespace lore::test;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

namespace fs = std::filesystem;

class Start : public ProgramTest {
protected:
    Start() : ProgramTest{LORE_START} {}
};
class FirstRun : public ProgramTest {
protected:
    FirstRun() : ProgramTest{LORE_EVOLVE} {}
};
class FirstBase : public ProgramTest {
protected:
    FirstBase() : ProgramTest{LORE_KB} {}
};
class FirstCampaign : public ProgramTest {
protected:
    FirstCampaign() : ProgramTest{LORE_CAMPAIGN} {}
    std::string const campaigns = LORE_SOURCE_DIR "/jobs/campaigns/";
};

}   // namespace

TEST_F(Start, shows_the_programs_and_the_commands_to_begin_with) {
    for (char const* const way : {"", "help", "--help"}) {
        Ran const ran = run(way);
        EXPECT_EQ(ran.exit_code, 0) << ran.errors;
        for (char const* const name : {"evolve", "kb", "replay", "campaign", "world"})
            EXPECT_THAT(ran.output, HasSubstr(std::string{"\n  lore "} + name));
        EXPECT_THAT(ran.output, HasSubstr("  cp -r " LORE_SOURCE_DIR "/jobs .\n  lore evolve jobs/tasks/source.toml"));
    }
    fs::create_directories(scratch.file("jobs/tasks"));
    write("jobs/tasks/source.toml", "");
    EXPECT_THAT(run("").output, Not(HasSubstr("cp -r"))) << "they are here already";
}

TEST_F(Start, is_another_way_to_call_the_programs) {
    EXPECT_EQ(run("evolve --version").output, run_program(LORE_EVOLVE " --version", scratch.path()).output);
    EXPECT_THAT(run("help kb").output, HasSubstr("Usage: lore-kb"));
    Ran const refused = run("kb info nowhere.lorekb");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.errors, ::testing::StartsWith("lore-kb: cannot read nowhere.lorekb"));
}

TEST_F(Start, names_the_program_that_was_meant) {
    expect_refusal("evovle", 2, "Did you mean 'lore evolve'?");
    expect_refusal("xyzzy", 2, "'lore' says what they are for.");
    expect_refusal("--evolve", 2, "See 'lore --help'.");
}

TEST_F(FirstRun, that_lacks_everything_is_shown_a_command_that_works) {
    expect_refusal("", 2, "Try 'lore-evolve jobs/tasks/source.toml --out runs/s1'");
    expect_refusal("jobs/tasks/source.toml", 2, "Add --out DIR, such as --out runs/s1.");
    expect_refusal("--out never --resume", 2, "there is no run in never to go on with");
}

TEST_F(FirstRun, of_a_task_that_is_elsewhere_is_told_where) {
    expect_refusal("jobs/tasks/source.toml --out never", 2,
                   "copy that with 'cp -r " LORE_SOURCE_DIR "/jobs .', or give the path there.");
    expect_refusal("jobs/tasks/nonsense.toml --out never", 2, "Check the path.");
    expect_refusal(LORE_SOURCE_DIR "/jobs/tasks/sorce.toml --out never", 2, "Did you mean 'source.toml'?");
    expect_refusal(LORE_SOURCE_DIR "/jobs/tasks --out never", 2, "Name a file in it.");
}

TEST_F(FirstRun, of_a_campaign_is_told_which_program_runs_it) {
    expect_refusal(LORE_SOURCE_DIR "/jobs/campaigns/small.toml --out never", 2, "Run it with 'lore-campaign run'");
}

TEST_F(FirstRun, with_a_misspelt_option_is_told_the_right_one) {
    expect_refusal("jobs/tasks/source.toml --oot never", 2, "Did you mean '--out'? See 'lore-evolve --help'.");
}

TEST_F(FirstRun, is_told_which_options_take_one_value_and_which_all_that_follow) {
    std::string const help = run("--help").output;
    EXPECT_THAT(help, HasSubstr("--set KEY=VALUE  "));
    EXPECT_THAT(help, HasSubstr("--founders FILE|DIR ...  "));
    EXPECT_THAT(help, HasSubstr("HH:MM:SS, MM:SS or seconds"));
}

TEST_F(FirstBase, without_or_with_a_misspelt_command_is_told_the_commands) {
    expect_refusal("", 2, "a command is expected: build, info, query");
    expect_refusal("biuld", 2, "Did you mean 'build'?");
    expect_refusal("build --out never", 2, "See 'lore-kb build --help'.");
    expect_refusal("build run --uot never", 2, "Did you mean '--out'? See 'lore-kb build --help'.");
}

TEST_F(FirstBase, of_what_is_no_run_is_told_where_runs_are) {
    expect_refusal("build nowhere --out never", 2, "Give the directory that 'lore-evolve --out' wrote.");
    fs::create_directories(scratch.file("campaign/runs/source/001"));
    expect_refusal("build campaign --out never", 2, "Give the directory that 'lore-evolve --out' wrote.");
    for (char const* const run : {"s2", "s1", "source/001"}) {
        fs::create_directories(scratch.file(fmt::format("campaign/runs/{}", run)));
        std::ofstream{scratch.file(fmt::format("campaign/runs/{}/config.toml", run))};
        expect_refusal("build campaign --out never", 2,
                       fmt::format("There are runs in campaign/runs: give one, such as campaign/runs/{}.",
                                   run == std::string_view{"s2"} ? "s2" : "s1"));
    }
}

TEST_F(FirstBase, of_an_unfinished_run_is_told_how_to_finish_it) {
    fs::create_directories(scratch.file("run"));
    fs::copy(LORE_SOURCE_DIR "/tests/data/version-1/stopped-run/config.toml", scratch.file("run/config.toml"));
    fs::copy(LORE_SOURCE_DIR "/tests/data/version-1/stopped-run/arena.toml", scratch.file("run/arena.toml"));
    expect_refusal("build run --out never", 1, "Let it go on with 'lore-evolve --resume --out run'.");
}

TEST_F(FirstCampaign, from_the_configuration_of_a_run_is_told_which_program_takes_it) {
    expect_refusal("run " LORE_SOURCE_DIR "/jobs/tasks/source.toml --dir never", 2, "Run it with 'lore-evolve'");
}

TEST_F(FirstCampaign, in_the_directory_of_a_run_is_refused) {
    fs::create_directories(scratch.file("run"));
    write("run/manifest.json", "{}");
    for (char const* const command : {"run ", "status ", "report "})
        expect_refusal(command + campaigns + "small.toml --dir run", 2, "it holds a run of lore-evolve");
}

TEST_F(FirstCampaign, whose_launcher_is_not_installed_starts_nothing) {
    expect_refusal("run " + campaigns + "small.toml --dir never --ranks 2 --launch 'no-such-mpirun -n {ranks}'", 2,
                   "there is no program 'no-such-mpirun'");
    expect_refusal("run " + campaigns + "small.toml --dir never --ranks 2 --launch 'true -n 2'", 2,
                   "'true -n 2' does not say where their number belongs");
}

TEST_F(FirstCampaign, that_is_not_there_is_said_to_be_missing) {
    Ran const ran = run("status -q " + campaigns + "small.toml --dir nowhere");
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_THAT(ran.errors, HasSubstr("nowhere is not there yet. 'lore-campaign run' makes it"));
}
