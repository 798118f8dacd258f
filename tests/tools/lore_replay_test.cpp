#include "support/c_worlds.h"
#include "support/program.h"
#include "support/small_run.h"

#include <lore/collectball/trace_file.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

using namespace lore;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace {

class LoreReplay : public test::ProgramTest {
protected:
    LoreReplay() : ProgramTest(LORE_REPLAY) {}
};

}   // namespace

TEST_F(LoreReplay, repeats_an_individual_of_a_run) {
    test::write_small_run(scratch.file("run"));
    test::Ran const ran = run("run --out replay");
    EXPECT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("wrote replay/trace.csv"));
    Arena const arena = load_arena("collectball", "source");
    RunDirectory const archived = open_run(scratch.file("run"));
    auto const steps =
        record_steps(CollectballWorld{arena}, compile(archived.individual("best")->genome), archived.config.episode);
    EXPECT_EQ(read_trace_csv(scratch.file("replay/trace.csv"), arena), steps);
    EXPECT_THAT(content("replay/trajectory.svg"), HasSubstr("<svg"));
    EXPECT_THAT(content("replay/trajectory.png"), HasSubstr("PNG"));
}

TEST_F(LoreReplay, colors_the_trajectory_by_one_knowledge_base_or_by_the_product_of_several) {
    test::write_small_run(scratch.file("run"));
    ASSERT_EQ(test::run_program(LORE_KB " build " + scratch.file("run") + " -q --out " + scratch.file("kb.lorekb"),
                                scratch.path())
                  .exit_code,
              0);
    EXPECT_THAT(run("run --kb kb.lorekb --out one").output, HasSubstr("20 of 20 windows in the knowledge base"))
        << "its own lineage made the knowledge base";
    EXPECT_THAT(content("one/trajectory.svg"), HasSubstr("value (balls)"));
    expect_done("--kb kb.lorekb --kb kb.lorekb run --out two");
    EXPECT_THAT(content("two/trajectory.svg"), HasSubstr("product of 2 values (balls^2)"));
}

TEST_F(LoreReplay, shows_a_run_in_another_world_over_its_scene) {
    test::write_small_run(scratch.file("run"), 1, {test::c_world("pendulum"), "", ""});
    std::string const unit = open_run(scratch.file("run")).world.world->facts().reward_unit;
    ASSERT_EQ(test::run_program(LORE_KB " build " + scratch.file("run") + " -q --out " + scratch.file("kb.lorekb"),
                                scratch.path())
                  .exit_code,
              0);
    test::Ran const ran = run("run --kb kb.lorekb --out replay");
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr(" " + unit + " in 400 steps, 20 of 20 windows in the knowledge base"));
    EXPECT_THAT(content("replay/trace.csv"), StartsWith("step,x,y,in0,"));
    EXPECT_THAT(content("replay/trajectory.svg"), HasSubstr("value (" + unit + ")"));
    EXPECT_THAT(content("replay/trajectory.svg"), HasSubstr(">start</text>"));
    EXPECT_THAT(content("replay/trajectory.png"), HasSubstr("PNG"));
    test::write_small_run(scratch.file("arena"));
    expect_refusal("arena --kb kb.lorekb --out never", 2, "cannot use kb.lorekb");
}

TEST_F(LoreReplay, drives_by_actions_and_follows_what_it_wrote) {
    write("actions.csv", "a0,a1,a2\n0.9,0.9,1\n0.9,0.8,1\n0.1,0.9,0\n");
    expect_done("--actions actions.csv --task target --out driven.csv");
    expect_done("--follow driven.csv --task target --out followed.csv");
    EXPECT_EQ(content("followed.csv"), content("driven.csv"));
    EXPECT_EQ(run("-q --follow driven.csv --task target --out followed.csv").output, "");
}

TEST_F(LoreReplay, refuses_a_wrong_command_line) {
    write("actions.csv", "a0,a1,a2\n1,1,1\n");
    test::write_small_run(scratch.file("run"));
    expect_refusal("--out never", 2, "nothing to replay");
    expect_refusal("run --actions actions.csv --task source --out never", 2, "more than one thing");
    expect_refusal("--actions actions.csv --out never", 2, "need a task");
    expect_refusal("--actions actions.csv --task suorce --out never", 2, "Did you mean 'source'?");
    expect_refusal("--actions actions.csv --task source --arena none --out never", 2, "cannot read arena none");
    expect_refusal("--actions actions.csv --task source --kb kb.lorekb --out never", 2, "go with a run");
    expect_refusal("run --task source --out never", 2, "knows its own");
    expect_refusal("run --individual 77.1 --out never", 2, "not in");
    expect_refusal("run --kb none.lorekb --out never", 2, "none.lorekb");
    expect_refusal("nowhere --out never", 2, "no run in nowhere");
    expect_refusal("run --out never --verbose", 2, "--verbose");
}

TEST_F(LoreReplay, refuses_wrong_files) {
    write("short.csv", "a0,a1\n1,1\n");
    write("nan.csv", "a0,a1,a2\n1,nan,1\n");
    write("few.csv", "a0,a1,a2\n1,1\n");
    expect_refusal("--actions short.csv --task source --out never", 1, "no column 'a2'");
    expect_refusal("--actions nan.csv --task source --out never", 1, "line 2, column a1");
    expect_refusal("--actions few.csv --task source --out never", 1, "line 2 has 2 fields, the header 3");
    expect_refusal("--actions none.csv --task source --out never", 2, "No such file");
    expect_refusal("--follow nan.csv --task source --out never", 1, "no column 'step'");
}

TEST_F(LoreReplay, refuses_a_run_whose_archive_tells_another_story) {
    test::write_small_run(scratch.file("run"));
    Population impostors;
    impostors.members.emplace_back().birth = std::make_shared<Birth>(
        Birth{{0, 0}, nullptr, founder(Interface{collectball_channels()}, Stream{1, Purpose::test}), 99});
    write_lineage(scratch.file("run/lineage.lore"), impostors, open_run(scratch.file("run")).world.record());
    expect_refusal("run --out never", 1, "does not repeat");
}

TEST_F(LoreReplay, tells_its_version_and_how_to_use_it) {
    EXPECT_THAT(run("--version").output, StartsWith("lore-replay "));
    EXPECT_THAT(run("--help").output, HasSubstr("Examples:"));
}
