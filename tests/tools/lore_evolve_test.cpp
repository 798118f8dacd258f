// Runs that were stopped half way by commit e8a0ef9, kept in tests/data: every later version goes on with them to the
// signature that they would have had. tests/data/version-1/make-stopped-runs made them.

#include "support/program.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/checkpoint.h>
#include <lore/experiment/run_directory.h>

using namespace lore;
using namespace lore::test;
using ::testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

fs::path const stored{LORE_SOURCE_DIR "/tests/data/version-1"};

std::string text_of(fs::path const& path) {
    auto const bytes = read_file(path.string());
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

class StoppedRun : public ProgramTest {
protected:
    StoppedRun() : ProgramTest{LORE_EVOLVE} {
        for (char const* const run : {"stopped-run", "stopped-shaped-run"})
            fs::copy(stored / run, scratch.file(run), fs::copy_options::recursive);
        fs::copy(stored / "stopped-run.toml", scratch.file("tiny.toml"));
        fs::copy(stored / "stopped-shaped-run.lorekb", scratch.file("kb"));
    }

    /// Goes on to the end, and expects the signature of the run that was never stopped.
    void expect_same_end(std::string const& run_name, std::string const& more = "") {
        Ran const ran = run("--resume -q --out " + run_name + more);
        EXPECT_EQ(ran.exit_code, 0) << ran.errors;
        EXPECT_THAT(ran.output, ::testing::EndsWith(text_of(stored / (run_name + ".signature"))));
    }
    /// A generation more, and a stop.
    void go_a_step_further(std::string const& more = "") {
        Ran const ran = run("--resume -q --max-time 00:00:00 --out stopped-run" + more);
        EXPECT_EQ(ran.exit_code, 75) << ran.errors;
    }
    std::uint64_t digest_in(std::string const& checkpoint) {
        return read_checkpoint(scratch.file("stopped-run/" + checkpoint), "").checkpoint.config_digest;
    }
    void change(std::string const& file, std::string const& former, std::string const& present) {
        std::string text = text_of(scratch.file(file));
        ASSERT_NE(text.find(former), std::string::npos);
        text.replace(text.find(former), former.size(), present);
        write_file_atomically(scratch.file(file), std::string_view{text});
    }
};

}   // namespace

TEST_F(StoppedRun, ends_with_the_signature_of_one_that_ran_through) {
    expect_same_end("stopped-run", " tiny.toml --seed 5 --archive all");
}

TEST_F(StoppedRun, with_a_knowledge_base_does_so_too) { expect_same_end("stopped-shaped-run", " --kb kb"); }

TEST_F(StoppedRun, may_stop_again_and_lose_its_newer_checkpoint) {
    std::uint64_t const former = digest_in(run_file::checkpoint);
    go_a_step_further();
    EXPECT_NE(digest_in(run_file::checkpoint), former);
    EXPECT_EQ(digest_in(run_file::older_checkpoint), digest_in(run_file::checkpoint));
    write_file_atomically(scratch.file("stopped-run/checkpoint.lore"), "damaged");
    expect_same_end("stopped-run");
}

TEST_F(StoppedRun, does_not_mind_other_words_in_its_configuration) {
    go_a_step_further();
    change("stopped-run/config.toml", "length of an evaluation", "steps of an episode");
    change("stopped-run/config.toml", "eta = 15  ", "");   // that is its default
    expect_same_end("stopped-run");
}

TEST_F(StoppedRun, may_go_further_and_keep_other_checkpoints) {
    go_a_step_further(" --set checkpoint.generations=1 --set evolution.generations=15 --set name=longer");
    EXPECT_THAT(text_of(scratch.file("stopped-run/config.toml")), HasSubstr("name = \"longer\""));
    expect_same_end("stopped-run", " --set evolution.generations=12 --set checkpoint.minutes=7");
}

TEST_F(StoppedRun, under_settings_that_affect_results_is_refused_and_told_which) {
    std::string const says = "cannot go on with stopped-run under another configuration (it was started with "
                             "episode.steps = 120, not 100; evolution.population = 6, not 4)";
    std::string const other = " --set evolution.population=4 --set episode.steps=100";
    expect_refusal("--resume --out stopped-run tiny.toml" + other, 2, says);
    expect_refusal("--resume --out stopped-run" + other, 2, says);
}

TEST_F(StoppedRun, whose_settings_were_changed_behind_its_back_is_refused) {
    std::string const says = "config.toml or arena.toml was changed since its checkpoint";
    change("stopped-run/config.toml", "population = 6", "population = 4");
    expect_refusal("--resume --out stopped-run", 2, says);
    change("stopped-run/config.toml", "population = 4", "population = 6");
    go_a_step_further();
    change("stopped-run/config.toml", "population = 6", "population = 4");
    expect_refusal("--resume --out stopped-run", 2, says);
    expect_refusal("--resume --out stopped-run tiny.toml", 2, "it was started with evolution.population = 4, not 6");
}
