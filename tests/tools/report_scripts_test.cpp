// tools/bench-report, tools/bench-compare and tools/scaling-report: what they write from recorded measurements, and
// that they can measure.
#include "support/command.h"
#include "support/program.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

using namespace lore;
namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

namespace {

class ReportScripts : public ::testing::Test {
protected:
    test::Ran run(std::string const& script, std::string const& arguments) {
        return test::run_program("python3 -B " LORE_SOURCE_DIR "/tools/" + script + " " + arguments, scratch.path());
    }
    std::string from_sample() const {
        return "--from " LORE_SOURCE_DIR "/tests/tools/speed_sample.json --results " + results;
    }

    Scratch scratch;
    std::string const results = scratch.file("results.md");
};

/// Builds whose programs only say what they would have measured.
class BuildsThatAreCompared : public ReportScripts {
protected:
    /// A run takes `ms` of processor time after it has slept `asleep_ms`, a step `ns`; runs note the processors that
    /// they may use in NAME.processors.
    void make_build(std::string const& name, int ms, int ns, std::string const& signature = "00000000000000aa",
                    int asleep_ms = 0) {
        std::string const bin = scratch.file(name + "/bin");
        fs::create_directories(bin);
        program(bin + "/lore-evolve", R"py(#!/usr/bin/env python3
import os, sys, time
if "--version" in sys.argv:
    print("lore-evolve 1.0.0 (commit 0123456789ab)")
    print("compiled by g++ 12.2.0, Release")
    print("instruction set v4 (16 floats a vector)")
    sys.exit()
with open(")py" + scratch.file(name + ".processors") +
                                          R"py(", "a") as file:
    print(sorted(os.sched_getaffinity(0)), file=file)
begin = time.monotonic()
time.sleep()py" + std::to_string(asleep_ms) +
                                          R"py( / 1000)
while time.process_time() < )py" + std::to_string(ms) +
                                          R"py( / 1000:
    pass
out = sys.argv[sys.argv.index("--out") + 1]
os.mkdir(out)
with open(out + "/progress.csv", "w") as file:
    print(f"generation,best_balls,seconds\n0,0,0.0\n1,0,{time.monotonic() - begin}", file=file)
print("signature:", ")py" + signature + "\")\n");
        program(bin + "/lore-bench", R"sh(#!/bin/sh
if [ "$1" = --benchmark_list_tests ]; then
  echo episode/batch_of_200/40_connections/v4
  exit
fi
echo '{"benchmarks": [{"name": "", "run_name": "episode/batch_of_200/40_connections/v4", "run_type": "iteration",'
echo ' "cpu_time": 1.0, "time_unit": "ms", "step": )sh" +
                                         std::to_string(ns) + R"sh(e-9}]}'
)sh");
    }
    test::Ran compare(std::string const& arguments) {
        return test::run_program("cd " + scratch.path() +
                                     " && python3 -B " LORE_SOURCE_DIR "/tools/bench-compare --busy-anyway " +
                                     arguments,
                                 scratch.path());
    }

private:
    static void program(std::string const& path, std::string const& text) {
        std::ofstream{path} << text;
        fs::permissions(path, fs::perms::owner_all);
    }
};

}   // namespace

TEST_F(ReportScripts, set_each_median_beside_its_target_and_judge_it) {
    ASSERT_EQ(run("bench-report", from_sample()).exit_code, 0);
    std::string const text = file_text(results);
    EXPECT_THAT(text, HasSubstr("40 connections, AVX-512 | 15.5 ns | 14 .. 16 ns | <= 15 ns | <= 8 ns | **missed** |"));
    EXPECT_THAT(text, HasSubstr("| 11 ms | 10 .. 12 ms | <= 18 ms | <= 11 ms | aim reached |"));
    EXPECT_THAT(text,
                HasSubstr("| 1.85 times |  | >= 1.8 times | >= 1.9 times | target reached |"));   // more is better
    EXPECT_THAT(text, HasSubstr("| fronts, 400 x 3 objectives | 22 us |  |  |  |  |"));   // no target, no verdict
    EXPECT_THAT(text, HasSubstr("Commit `0123456789ab` (with changes that are not committed), g++ 12.2.0, Release"));
    EXPECT_THAT(text, HasSubstr("A note."));
}

TEST_F(ReportScripts, replace_what_stands_between_their_marks_and_nothing_else) {
    std::ofstream{results} << "# Title\n\nbefore\n<!-- speed: begin -->\nold figures\n<!-- speed: end -->\nafter\n";
    ASSERT_EQ(run("bench-report", from_sample()).exit_code, 0);
    std::string const once = file_text(results);
    EXPECT_THAT(once, StartsWith("# Title\n\nbefore\n<!-- speed: begin -->\n"));
    EXPECT_THAT(once, ::testing::EndsWith("<!-- speed: end -->\nafter\n"));
    EXPECT_THAT(once, Not(HasSubstr("old figures")));
    ASSERT_EQ(run("bench-report", from_sample()).exit_code, 0);
    EXPECT_EQ(file_text(results), once);
}

TEST_F(ReportScripts, refuse_what_they_do_not_know_and_a_build_that_is_not_there) {
    test::Ran const unknown = run("bench-report", "--only stride");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.errors, HasSubstr("unknown part 'stride'"));
    test::Ran const nowhere = run("bench-report", "--build " + scratch.path() + " --only step --busy-anyway");
    EXPECT_EQ(nowhere.exit_code, 1);
    EXPECT_THAT(nowhere.errors, HasSubstr("it was not built"));
}

#ifdef LORE_BENCH   // not every build has lore-bench
TEST_F(ReportScripts, measure_a_part_that_is_asked_for_alone) {
    test::Ran const ran =
        run("bench-report", "--build " LORE_BINARY_DIR " --only message --seconds 0.01 --repetitions 1 --busy-anyway");
    EXPECT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("| packing a genome | "));
    EXPECT_THAT(ran.output, Not(HasSubstr("one step")));
}
#endif

TEST_F(BuildsThatAreCompared, get_the_median_ratio_of_their_pairs_and_its_range) {
    make_build("old", 20, 30);
    make_build("new", 20, 24);
    test::Ran const ran = compare("old new --pairs 3 --only step,source,start --csv table.csv");
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("A: the build in old (0123456789ab)."));
    EXPECT_THAT(ran.output, HasSubstr("Medians of 3 pairs, below 1 B is faster"));
    EXPECT_THAT(ran.output,
                HasSubstr("| one step, 40 connections, AVX-512 | 30 ns | 24 ns | 0.800 | 0.800 .. 0.800 |"));
    EXPECT_THAT(ran.output, HasSubstr("| source generation, 1 rank | "));
    EXPECT_THAT(ran.output, HasSubstr("| a run of one generation, start and end included, target | "));
    EXPECT_THAT(ran.output, Not(HasSubstr("200 connections")));   // they do not have it
    EXPECT_THAT(ran.output, Not(HasSubstr("differ")));
    EXPECT_THAT(file_text(scratch.file("table.csv")),
                StartsWith("figure,unit,a,b,ratio,least,most,pairs\n"
                           "\"one step, 40 connections, AVX-512\",ns,30,24,0.8000,0.8000,0.8000,3\n"));
}

TEST_F(BuildsThatAreCompared, run_on_one_rank_at_once_on_one_processor_and_by_its_time) {
    make_build("idle", 100, 30, "00000000000000aa", 2000);
    make_build("at_work", 600, 30);
    test::Ran const ran = compare("idle at_work --pairs 2 --only source");
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    // By the clock the idle one would be the slower.
    EXPECT_THAT(ran.output,
                ContainsRegex("source generation, 1 rank [^|]*[|][^|]*ms [|][^|]*ms [|] [1-9][0-9]*[.][0-9]"));
    std::string const processors = file_text(scratch.file("idle.processors"));
    EXPECT_EQ(processors, file_text(scratch.file("at_work.processors")));
    EXPECT_THAT(processors, Not(HasSubstr(",")));   // one each time
}

TEST_F(BuildsThatAreCompared, are_told_apart_where_their_runs_are_not_the_same_run) {
    make_build("old", 20, 30);
    make_build("other", 20, 30, "00000000000000bb");
    test::Ran const ran = compare("old other --pairs 1 --only source");
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("**The source runs differ**: signature 00000000000000aa of A, 00000000000000bb"));
}

TEST_F(BuildsThatAreCompared, must_be_builds_or_commits) {
    make_build("old", 20, 30);
    test::Ran const ran = compare("old no-such-commit");
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.errors, StartsWith("bench-compare: 'no-such-commit' is neither a commit nor a build folder"));
    test::Ran const unknown = compare("old old --only stride");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.errors, HasSubstr("unknown part 'stride'"));
    EXPECT_EQ(compare("old old --pairs 0").exit_code, 2);
}

TEST_F(BuildsThatAreCompared, must_share_a_benchmark_of_a_step_if_steps_are_compared) {
    make_build("old", 20, 30);
    make_build("other", 20, 30);
    std::ofstream{scratch.file("other/bin/lore-bench")} << "#!/bin/sh\necho episode/of_another_name\n";
    test::Ran const ran = compare("old other --pairs 1 --only step");
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.errors, StartsWith("bench-compare: the two builds share no benchmark of a step"));
}

TEST_F(ReportScripts, keep_the_tables_of_scaling_md_those_of_its_csv) {
    std::string const committed = LORE_SOURCE_DIR "/docs/findings/scaling.md", copy = scratch.file("scaling.md");
    std::filesystem::copy_file(committed, copy);
    test::Ran const ran = run("scaling-report", "--from-csv --document " + copy);
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_EQ(file_text(copy), file_text(committed));
}
