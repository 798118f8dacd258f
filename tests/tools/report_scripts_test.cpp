// tools/bench-report and tools/scaling-report: what they write from recorded measurements, and that they can measure.
#include "support/command.h"
#include "support/program.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

using namespace lore;
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

TEST_F(ReportScripts, keep_the_tables_of_scaling_md_those_of_its_csv) {
    std::string const committed = LORE_SOURCE_DIR "/docs/findings/scaling.md", copy = scratch.file("scaling.md");
    std::filesystem::copy_file(committed, copy);
    test::Ran const ran = run("scaling-report", "--from-csv --document " + copy);
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_EQ(file_text(copy), file_text(committed));
}
