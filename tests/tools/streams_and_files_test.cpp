// What happens around a run: streams that are closed or cannot be written, files that are none.

#include "support/program.h"
#include "system/evolve_command.h"

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

class Door : public ::testing::Test {
protected:
    Door() : config(small_config(scratch, 12)), run_directory(scratch.file("run")) {}

    /// A line for bash, where $program, $kb, $play and $campaign are the programs, and $evolve is a whole command.
    test::Ran shell(std::string const& line) {
        std::string const path = scratch.file("line.sh");
        write_file_atomically(path, "program=" + program("lore-evolve") +
                                        "\nevolve=\"$program small.toml --out run\"\nkb=" + program("lore-kb") +
                                        "\nplay=" + program("lore-replay") + "\ncampaign=" + program("lore-campaign") +
                                        "\n" + line + "\n");
        return test::run_program("cd " + scratch.path() + " && bash " + path, scratch.path());
    }
    void expect_whole_run() {
        test::Ran const verified = shell("$kb verify run");
        EXPECT_EQ(verified.exit_code, 0) << verified.errors;
        EXPECT_THAT(file_text(run_directory + "/manifest.json"), HasSubstr("\"status\": \"done\""));
    }

    Scratch scratch;
    std::string config, run_directory;
};

using Streams = Door;
using Files = Door;

}   // namespace

TEST_F(Streams, that_are_closed_damage_no_file) {
    for (char const* const closing : {">&- 2>&-", "<&- 2>&-", "<&- >&-", "<&- >&- 2>&-", "2>&-"}) {
        shell("rm -rf run; $evolve " + std::string{closing});
        expect_whole_run();
    }
}

TEST_F(Streams, for_progress_that_cannot_be_written_stop_no_run) {
    for (char const* const line :
         {"$evolve 2>/dev/full", "$evolve 2>&-", "exec 3> >(exec true); wait $!; $evolve 2>&3"}) {
        test::Ran const ran = shell("rm -rf run; " + std::string{line});
        EXPECT_EQ(ran.exit_code, 0) << line << ": " << ran.errors;
        EXPECT_THAT(ran.output, HasSubstr("\nsignature: ")) << line;
        expect_whole_run();
    }
}

TEST_F(Streams, that_nobody_reads_any_more_end_events) {
    ASSERT_EQ(shell("$evolve -q").exit_code, 0);
    test::Ran const ran =
        shell("mkdir all; mv run all/run; (timeout 60 $campaign events all --follow; echo $? >code) | head -n 1");
    EXPECT_EQ(file_text(scratch.file("code")), "1\n") << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("cannot write the result to stdout (Broken pipe)"));
}

TEST_F(Streams, for_the_signature_that_cannot_be_written_end_a_saved_run_with_one_line) {
    for (char const* const line :
         {"$evolve -q >/dev/full", "$evolve -q >&-", "exec 3> >(exec true); wait $!; $evolve -q >&3"}) {
        test::Ran const ran = shell("rm -rf run; " + std::string{line});
        EXPECT_EQ(ran.exit_code, 1) << line;
        EXPECT_THAT(ran.errors, ::testing::StartsWith("lore-evolve: cannot write the result to stdout (")) << line;
        EXPECT_THAT(ran.errors, HasSubstr("The run is saved")) << line;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
        expect_whole_run();
    }
}

TEST_F(Streams, that_are_all_closed_end_no_program_by_a_signal) {
    for (char const* const name : {"lore-evolve", "lore-kb", "lore-replay", "lore-campaign"}) {
        EXPECT_EQ(shell(program(name) + " --help >&- 2>&-").exit_code, 1) << name << ": the help is the result";
        EXPECT_EQ(shell(program(name) + " --nonsense <&- >&- 2>&-").exit_code, 2) << name;
        EXPECT_EQ(shell(program(name) + " --nonsense 2>/dev/full").exit_code, 2) << name;
        EXPECT_EQ(shell(program(name) + " --help 2>/dev/full").exit_code, 0) << name;
    }
}

TEST_F(Files, that_are_pipes_are_read_like_others) {
    for (char const* const line :
         {"$program <(cat small.toml) --out run -q", "cat small.toml | $program /dev/stdin --out run -q",
          "mkfifo pipe; (sleep 0.2; cat small.toml >pipe) & $program pipe --out run -q"}) {
        test::Ran const ran = shell("rm -rf run pipe; " + std::string{line});
        EXPECT_EQ(ran.exit_code, 0) << line << ": " << ran.errors;
        expect_whole_run();
    }
    EXPECT_EQ(shell("$program <(cat small.toml) --out run -q --resume").exit_code, 0);
    EXPECT_EQ(shell("$program /dev/null --out null -q --set evolution.generations=0 --set episode.steps=20").exit_code,
              0)
        << "an empty configuration is a legal one";
}

TEST_F(Files, without_an_end_or_a_writer_are_refused_in_one_line) {
    shell("mkfifo pipe; $evolve -q; $kb build run --out base.lorekb");
    for (char const* const line :
         {"$program /dev/zero --out never", "$program pipe --out never",
          "$program small.toml --kb <(cat base.lorekb) --out never", "$program small.toml --kb pipe --out never",
          "$program small.toml --kb /dev/zero --out never", "$program small.toml --set arena=/dev/zero --out never",
          "$kb info pipe", "$kb verify pipe", "$kb info /dev/zero",
          "$play --follow /dev/zero --task source --out never", "$campaign plan /dev/zero --dir never",
          "$campaign test /dev/zero pipe"}) {
        test::Ran const ran = shell(line);
        EXPECT_EQ(ran.exit_code, 2) << line << ": " << ran.errors;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << line << ": " << ran.errors;
        EXPECT_FALSE(exists(scratch.file("never"))) << line;
    }
    EXPECT_EQ(shell("$kb info <(cat base.lorekb)").exit_code, 0);
    EXPECT_EQ(shell("$campaign test <(echo 1) <(echo 2)").output,
              shell("echo 1 >a; echo 2 >b; $campaign test a b").output);
}

TEST_F(Files, whose_names_are_wrong_end_every_program_with_exit_code_2) {
    shell("$evolve -q; $kb build run --out base.lorekb; echo a0,a1,a2 >actions.csv; echo 1,1,1 >>actions.csv");
    for (char const* const line : {"$program missing --out never",
                                   "$program . --out never",
                                   "$program small.toml --kb missing --out never",
                                   "$program small.toml --kb . --out never",
                                   "$program small.toml --set arena=missing --out never",
                                   "$program small.toml --set arena=. --out never",
                                   "$kb build missing --out never",
                                   "$kb build base.lorekb --out never",
                                   "$kb info missing",
                                   "$kb info .",
                                   "$kb verify missing",
                                   "$kb query missing --run run --csv never",
                                   "$kb query base.lorekb --run missing --csv never",
                                   "$kb query base.lorekb --windows missing.npy --csv never",
                                   "$kb product base.lorekb missing --run run --csv never",
                                   "$kb reduce base.lorekb --consensus missing --out never",
                                   "$kb export missing --csv never",
                                   "$play missing --out never",
                                   "$play run --kb missing --out never",
                                   "$play --actions missing --task source --out never",
                                   "$play --follow . --task source --out never",
                                   "$play --actions actions.csv --task source --arena missing --out never",
                                   "$campaign plan missing --dir never",
                                   "$campaign run . --dir never",
                                   "$campaign report missing --dir never",
                                   "$campaign report " LORE_SOURCE_DIR "/jobs/campaigns/small.toml --dir never",
                                   "$campaign test missing missing"}) {
        test::Ran const ran = shell(line);
        EXPECT_EQ(ran.exit_code, 2) << line << ": " << ran.errors;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << line << ": " << ran.errors;
        EXPECT_FALSE(exists(scratch.file("never"))) << line;
    }
}

TEST_F(Files, of_another_world_are_refused_before_anything_is_looked_up) {
    shell("$evolve -q; $program " LORE_SOURCE_DIR
          "/jobs/tasks/maze_medium.toml --set evolution.generations=0 --set evolution.population=4 --out maze -q; "
          "$kb build maze --out maze.lorekb");
    for (char const* const line :
         {"$kb query maze.lorekb --run run --csv never", "$kb product maze.lorekb --run run --csv never",
          "$play run --kb maze.lorekb --out never"}) {
        test::Ran const ran = shell(line);
        EXPECT_EQ(ran.exit_code, 2) << line;
        EXPECT_THAT(ran.errors, ::testing::HasSubstr("cannot use maze.lorekb (")) << line;
        EXPECT_FALSE(exists(scratch.file("never"))) << line;
    }
}

TEST_F(Files, of_a_resumed_run_that_was_killed_are_as_its_manifest_says) {
    shell("$program small.toml --out killed -q --set evolution.generations=1000000 --max-time 00:00:00");
    shell("$program --out killed --resume -q & before=$(wc -l <killed/progress.csv)\n"
          "for i in $(seq 600); do\n"
          "  grep -q '\"status\": \"running\"' killed/manifest.json && [ $(wc -l <killed/progress.csv) -gt $before ] "
          "&& break\n"
          "  sleep 0.1\n"
          "done; kill -KILL $!; wait");
    EXPECT_THAT(shell("$kb verify killed/manifest.json").output, ::testing::HasSubstr("(running), 0 outputs"));
    test::Ran const ran = shell("$kb verify killed");
    EXPECT_EQ(ran.exit_code, 0) << ran.errors;
}

TEST_F(Files, that_cannot_be_looked_at_are_named) {
    std::string const name(300, 'x');
    for (std::string const& line : {"$program small.toml --out " + name, "$kb individuals " + name}) {
        test::Ran const ran = shell(line);
        EXPECT_EQ(ran.exit_code, 1) << line;
        EXPECT_THAT(ran.errors, ::testing::HasSubstr(": cannot look at " + name)) << line;
        EXPECT_THAT(ran.errors, ::testing::EndsWith(" (File name too long). Check the path.\n")) << line;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
    }
}

TEST_F(Files, that_have_moved_are_read_where_they_are_now) {
    shell("mkdir -p jobs/tasks; cp small.toml jobs/tasks/mine.toml");
    test::Ran const ran = shell("$program jobs/mine.toml --out run -q");
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.errors,
              "jobs/mine.toml has moved to jobs/tasks/mine.toml; the old name works in every 1.x, not in 2.\n");
    EXPECT_THAT(file_text(run_directory + "/manifest.json"), HasSubstr("\"path\": \"jobs/tasks/mine.toml\""));
}
