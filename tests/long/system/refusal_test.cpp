// What lore-evolve refuses, in which words, and with which exit code; and that nothing is lost by it.

#include "system/evolve_command.h"

#include <lore/archive/knowledge_file.h>
#include <lore/collectball/collectball.h>

#include <gmock/gmock.h>

#include <memory>

#include <sys/mount.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

struct Refusal {
    int code;
    std::string line;   ///< all of stderr
};

Refusal refusal(Scratch const& scratch, std::vector<std::string> const& words) {
    Command command{scratch, words};
    int const code = command.wait();
    EXPECT_EQ(command.out(), "");
    return {code, command.err()};
}

bool is_one_line(std::string const& text) { return !text.empty() && text.find('\n') == text.size() - 1; }

/// A knowledge base of one feature.
void write_small_base(std::string const& path, int window_length, float threshold) {
    KnowledgeConfig config;
    config.window_length = window_length;
    config.match_threshold = threshold;
    config.channels = collectball_channels();
    KnowledgeArrays arrays;
    arrays.bits.assign(static_cast<std::size_t>(window_length), 0);
    arrays.windows.assign(static_cast<std::size_t>(window_length) * 6, 0.5f);
    arrays.values = {2.0};
    arrays.reward_sums = {4.0};
    arrays.counts = {2};
    Provenance provenance;
    provenance.kind = "lineage";
    write_knowledge_base(path, KnowledgeBase{config, provenance, std::move(arrays)});
}

}   // namespace

TEST(CommandLine, mistakes_are_one_line_and_exit_code_2) {
    Scratch const scratch;
    std::string const config = small_config(scratch), evolve_ = program("lore-evolve"), out = scratch.file("o");
    for (auto const& words :
         std::vector<std::vector<std::string>>{{evolve_},
                                               {evolve_, "--nonsense"},
                                               {evolve_, config},
                                               {evolve_, "--out", out},
                                               {evolve_, scratch.file("missing.toml"), "--out", out},
                                               {evolve_, config, "--out", out, "--seed", "minus"},
                                               {evolve_, config, "--out", out, "--archive", "some"},
                                               {evolve_, config, "--out", out, "--max-time", "soon"},
                                               {evolve_, config, "--out", out, "--max-time", ""},
                                               {evolve_, config, "--out", out, "--max-time", "0:99:99"},
                                               {evolve_, "--bench", "--out", out},
                                               {evolve_, "--bench", config},
                                               {evolve_, config, "--out", out, "--founders", scratch.file("\xff")},
                                               {evolve_, config, "--out", out, "--kb", ""},
                                               {evolve_, config, "--out", out, "--seed", "-1"},
                                               {evolve_, config, "--out", out, "--seed", "0x10"},
                                               {evolve_, config, "--out", out, "--seed", "18446744073709551616"},
                                               {evolve_, config, "--ou", out},
                                               {evolve_, config, "--out", out, "--set", "evolution.generatoins=3"},
                                               {"LORE_ISA=v9", evolve_, config, "--out", out},
                                               {"LORE_WAITING=badly", evolve_, config, "--out", out},
                                               {"SLURM_NTASKS=4", evolve_, config, "--out", out}}) {
        Refusal const said = refusal(scratch, words);
        EXPECT_EQ(said.code, 2) << said.line;
        EXPECT_TRUE(is_one_line(said.line)) << said.line;
        EXPECT_FALSE(exists(out)) << "what is refused leaves nothing behind";
    }
    EXPECT_THAT(refusal(scratch, {evolve_, config, "--ou", out}).line, HasSubstr("'--ou' was not expected"));
    // As the launcher of another MPI starts it.
    std::string const foreign = launcher_is_mpich ? "OMPI_COMM_WORLD_SIZE=2" : "PMI_SIZE=2";
    Refusal const copy = refusal(scratch, {foreign, evolve_, config, "--out", out});
    EXPECT_EQ(copy.code, 2);
    EXPECT_THAT(copy.line, HasSubstr("its launcher started 2, but they do not find each other"));
    EXPECT_FALSE(exists(out));
    Refusal const on_two = refusal(scratch, on_ranks(2) + std::vector<std::string>{evolve_, config, "--out", out,
                                                                                   "--set", "evolution.generatoins=3"});
    EXPECT_EQ(on_two.code, 2);
    EXPECT_EQ(on_two.line,
              "lore-evolve: --set evolution.generatoins=3 (unknown key). Did you mean 'evolution.generations'?\n");
}

TEST(CommandLine, help_and_version_go_to_stdout) {
    Scratch const scratch;
    for (char const* const option : {"--help", "--version"}) {
        Command alone{scratch, {"SLURM_NTASKS=4", program("lore-evolve"), option}};   // as typed in an allocation
        EXPECT_EQ(alone.wait(), 0);
        EXPECT_THAT(alone.out(),
                    HasSubstr(option == std::string{"--help"} ? "mpirun -n 2 lore-evolve" : "instruction set"));
        Command two{scratch, on_ranks(2) + std::vector<std::string>{program("lore-evolve"), option}};
        EXPECT_EQ(two.wait(), 0);
        EXPECT_EQ(two.out(), alone.out()) << "printed once";
    }
}

TEST(CommandLine, takes_a_setting_and_then_the_configuration) {
    Scratch const scratch;
    std::string const config = small_config(scratch);
    Command command{
        scratch,
        {program("lore-evolve"), "--set", "evolution.generations=1", config, "--out", scratch.file("o"), "-q"}};
    EXPECT_EQ(command.wait(), 0) << command.err();
}

TEST(Directory, whose_name_is_no_utf_8_is_no_origin_of_founders) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 1), odd = scratch.file("lat\xe9in");
    Command first{scratch, evolve(config, odd + "/run")};
    ASSERT_EQ(first.wait(), 0) << first.err();
    Refusal const said = refusal(scratch, std::vector<std::string>{"bash", "-c", "cd \"$0\" && exec \"$@\"", odd} +
                                              evolve(config, scratch.file("o"), {"--founders", "run"}));
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.line, HasSubstr("the path is no printable UTF-8"));
    EXPECT_FALSE(std::filesystem::exists(scratch.file("o")));
}

TEST(Directory, with_the_name_of_a_built_in_arena_is_not_taken_for_it) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 1);
    std::filesystem::create_directory(scratch.file("collectball"));
    Command command{
        scratch,
        {"bash", "-c", "cd \"$0\" && exec \"$@\"", scratch.path(), program("lore-evolve"), config, "--out", "o", "-q"}};
    EXPECT_EQ(command.wait(), 0) << command.err();
    EXPECT_EQ(file_text(scratch.file("o/manifest.json")).find("\"role\": \"arena\""), std::string::npos);
}

TEST(Directory, that_holds_a_run_is_refused_without_resume) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 3), directory = scratch.file("run");
    Command first{scratch, evolve(config, directory)};
    ASSERT_EQ(first.wait(), 0) << first.err();
    std::string const before = results(directory) + file_text(directory + "/manifest.json");
    Refusal const said = refusal(scratch, evolve(config, directory));
    EXPECT_EQ(said.code, 2);
    EXPECT_EQ(said.line, "lore-evolve: " + directory +
                             " already holds a run (there is a config.toml). Continue it with --resume, or choose "
                             "another directory with --out.\n");
    EXPECT_EQ(results(directory) + file_text(directory + "/manifest.json"), before);
}

TEST(Directory, that_lost_its_configuration_is_not_written_over) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 3), directory = scratch.file("run");
    Command first{scratch, evolve(config, directory)};
    ASSERT_EQ(first.wait(), 0) << first.err();
    std::filesystem::remove(directory + "/config.toml");
    std::string const before = file_text(directory + "/lineage.lore") + file_text(directory + "/progress.csv");
    for (auto const& more : {std::vector<std::string>{}, std::vector<std::string>{"--resume"}}) {
        Refusal const said = refusal(scratch, evolve(config, directory, more));
        EXPECT_EQ(said.code, 2);
        EXPECT_THAT(said.line, HasSubstr("there is a checkpoint.lore, but no config.toml"));
        EXPECT_EQ(file_text(directory + "/lineage.lore") + file_text(directory + "/progress.csv"), before);
    }
}

TEST(Directory, of_a_running_run_is_refused) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 1000000), directory = scratch.file("run");
    Command first{scratch, evolve(config, directory)};
    ASSERT_TRUE(first.wait_until([&] { return exists(directory + "/progress.csv"); }));
    Refusal const said = refusal(scratch, evolve(config, directory, {"--resume"}));
    EXPECT_EQ(said.code, 1);
    EXPECT_THAT(said.line, HasSubstr("another process runs in " + directory));
    EXPECT_TRUE(first.running());
}

TEST(Directory, in_which_several_runs_start_at_once_goes_to_one_of_them) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 12), directory = scratch.file("run");
    std::vector<std::unique_ptr<Command>> contenders;
    for (int i = 0; i < 4; ++i)
        contenders.push_back(std::make_unique<Command>(scratch, std::vector<std::string>{"LORE_TEST_DELAY=10"} +
                                                                    evolve(config, directory)));
    int winners = 0;
    for (auto& contender : contenders) {
        int const code = contender->wait();
        winners += code == 0;
        if (code == 0) continue;
        EXPECT_TRUE(code == 1 || code == 2) << code;
        EXPECT_THAT(contender->err(),
                    ::testing::AnyOf(HasSubstr("another process runs in"), HasSubstr("already holds a run")));
        EXPECT_TRUE(is_one_line(contender->err())) << contender->err();
    }
    EXPECT_EQ(winners, 1);
    Command straight{scratch, evolve(config, scratch.file("straight"))};
    EXPECT_EQ(straight.wait(), 0);
    EXPECT_EQ(results(directory), results(scratch.file("straight")));
}

TEST(Directory, on_a_read_only_disk_is_refused_and_stays_as_it_is) {
    Scratch const scratch;
    std::string const disk = scratch.file("disk"), directory = disk + "/run";
    std::filesystem::create_directories(disk);
    if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=40m") != 0) GTEST_SKIP() << "no right to mount a tmpfs here";
    std::string const config = small_config(scratch, 1000000);
    {
        Command command{scratch, evolve(config, directory)};
        EXPECT_TRUE(command.wait_until([&] { return exists(directory + "/checkpoint.lore"); }));
        command.signal(SIGTERM);
        EXPECT_EQ(command.wait(), 75) << command.err();
    }
    std::string const before = results(directory);
    EXPECT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
    for (std::string const& place : {directory, disk + "/new"})
        for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)}) {
            Refusal const said = refusal(scratch, launcher + evolve(config, place, {"--resume"}));
            EXPECT_EQ(said.code, 1);
            EXPECT_THAT(said.line, HasSubstr("Read-only file system"));
            EXPECT_TRUE(is_one_line(said.line)) << said.line;
        }
    EXPECT_EQ(results(directory), before);
    ::umount(disk.c_str());
}

TEST(Directory, that_cannot_be_made_or_written_is_refused) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 3);
    write_file_atomically(scratch.file("file"), "x");
    for (std::string const& place : {scratch.file("file"), scratch.file("file/below"), std::string{"/proc/nothing"}}) {
        Refusal const said = refusal(scratch, evolve(config, place));
        EXPECT_EQ(said.code, 1) << said.line;
        EXPECT_TRUE(is_one_line(said.line)) << said.line;
    }
}

TEST(Directory, deleted_or_moved_under_a_run_ends_it_with_one_line) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 1000000), directory = scratch.file("run");
    for (bool const deleted : {true, false}) {
        Command command{scratch, evolve(config, directory)};
        ASSERT_TRUE(command.wait_until([&] { return exists(directory + "/checkpoint.lore"); }));
        std::filesystem::rename(directory,
                                scratch.file("elsewhere"));   // nothing is written into it by name from now on
        if (deleted) std::filesystem::remove_all(scratch.file("elsewhere"));
        EXPECT_EQ(command.wait(), 1);
        EXPECT_THAT(command.err(), HasSubstr("No such file or directory"));
        EXPECT_TRUE(is_one_line(command.err())) << command.err();
    }
}

TEST(FullDisk, ends_a_run_with_one_line_and_its_last_checkpoint_serves_on) {
    Scratch const scratch;
    std::string const disk = scratch.file("disk"), directory = disk + "/run";
    std::filesystem::create_directories(disk);
    if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=400k") != 0) GTEST_SKIP() << "no right to mount a tmpfs here";
    std::string const config = small_config(scratch, 700);
    for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)}) {
        Command command{scratch, launcher + evolve(config, directory, {"--resume"})};
        EXPECT_EQ(command.wait(), 1);
        EXPECT_THAT(command.err(), HasSubstr("No space left on device"));
        EXPECT_TRUE(is_one_line(command.err())) << command.err();
    }
    EXPECT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=40m"), 0);
    Command resumed{scratch, evolve(config, directory, {"--resume"})};
    EXPECT_EQ(resumed.wait(), 0) << resumed.err();
    Command straight{scratch, evolve(config, scratch.file("straight"))};
    EXPECT_EQ(straight.wait(), 0) << straight.err();
    EXPECT_EQ(signature(resumed), signature(straight));
    EXPECT_EQ(results(directory), results(scratch.file("straight")));
    ::umount(disk.c_str());
}

TEST(Resume, refuses_what_contradicts_the_run) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 1000000), directory = scratch.file("run");
    {
        Command first{scratch, evolve(config, directory, {"--seed", "3"})};
        ASSERT_TRUE(first.wait_until([&] { return exists(directory + "/checkpoint.lore"); }));
        first.signal(SIGTERM);
        ASSERT_EQ(first.wait(), 75) << first.err();
    }
    write_small_base(scratch.file("kb"), 20, 1.83f);
    struct Case {
        std::vector<std::string> more;
        char const* says;
    };
    for (Case const& one : {Case{{"--seed", "4"}, "it was started with --seed 3"},
                            Case{{"--set", "evolution.population=18"}, "evolution.population = 16, not 18"},
                            Case{{"--kb", scratch.file("kb")}, "the run was started without one"},
                            Case{{"--set", "evolution.generations=1"}, "Set evolution.generations higher"}}) {
        Refusal const said =
            refusal(scratch, evolve(config, directory, std::vector<std::string>{"--resume"} + one.more));
        EXPECT_EQ(said.code, 2) << said.line;
        EXPECT_THAT(said.line, HasSubstr(one.says));
    }
    std::string text = file_text(directory + "/config.toml");
    text.replace(text.find("eta = 15"), 8, "eta = 31");
    write_file_atomically(directory + "/config.toml", std::string_view{text});
    Refusal const said = refusal(scratch, {program("lore-evolve"), "--resume", "--out", directory});
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.line, HasSubstr("was changed since its checkpoint"));
}

TEST(Verify, finds_that_a_killed_run_could_not_go_on) {
    Scratch const scratch;
    std::string const run = scratch.file("run"), progress = run + "/progress.csv";
    {
        Command killed{scratch, evolve(small_config(scratch, endless), run)};
        ASSERT_TRUE(killed.wait_until([&] { return exists(run + "/checkpoint.lore"); }));
    }
    std::vector<std::string> const verify{program("lore-kb"), "verify", run};
    Command whole{scratch, verify};
    EXPECT_EQ(whole.wait(), 0) << whole.err();
    std::string const rows = file_text(progress), first = rows.substr(0, rows.find('\n') + 1);
    ASSERT_GT(rows.size(), first.size());
    std::ofstream{progress} << first;
    Refusal const cut = refusal(scratch, verify);
    EXPECT_EQ(cut.code, 1);
    EXPECT_THAT(cut.line, HasSubstr("progress.csv was cut"));
}

TEST(Resume, falls_back_to_the_older_checkpoint_with_a_warning) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 40), directory = scratch.file("run");
    Command straight{scratch, evolve(config, scratch.file("straight"))};
    ASSERT_EQ(straight.wait(), 0);
    {
        Command command{scratch, std::vector<std::string>{"LORE_TEST_DELAY=20"} + evolve(config, directory)};
        ASSERT_TRUE(command.wait_until([&] { return exists(directory + "/checkpoint-older.lore"); }));
        command.signal(SIGUSR1);
        ASSERT_EQ(command.wait(), 75);
    }
    auto bytes = read_file(directory + "/checkpoint.lore");
    bytes[bytes.size() / 2] ^= std::byte{4};
    write_file_atomically(directory + "/checkpoint.lore", std::span<std::byte const>{bytes});
    Command resumed{scratch, evolve(config, directory, {"--resume"})};
    EXPECT_EQ(resumed.wait(), 0) << resumed.err();
    EXPECT_THAT(resumed.err(), HasSubstr("warning: cannot read " + directory + "/checkpoint.lore (checksum mismatch"));
    EXPECT_EQ(signature(resumed), signature(straight));
    EXPECT_EQ(results(directory), results(scratch.file("straight")));
}

TEST(Resume, of_a_finished_run_writes_a_lost_or_damaged_lineage_again) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 3), directory = scratch.file("run"),
                      lineage = directory + "/lineage.lore";
    Command first{scratch, evolve(config, directory)};
    ASSERT_EQ(first.wait(), 0) << first.err();
    std::string const whole = file_text(lineage);
    for (bool const lost : {true, false}) {
        if (lost) std::filesystem::remove(lineage);
        else std::filesystem::resize_file(lineage, whole.size() / 2);
        Command again{scratch, evolve(config, directory, {"--resume"})};
        EXPECT_EQ(again.wait(), 0) << again.err();
        EXPECT_EQ(file_text(lineage), whole);
    }
}

TEST(Resume, that_fails_leaves_the_manifest_as_it_is) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 3), directory = scratch.file("run"),
                      manifest = directory + "/manifest.json";
    Command first{scratch, evolve(config, directory)};
    ASSERT_EQ(first.wait(), 0) << first.err();
    std::string const before = file_text(manifest);
    for (char const* const output : {"/progress.csv", "/all.lore"}) {
        std::string const whole = file_text(directory + output);
        std::filesystem::resize_file(directory + output, 10);
        Refusal const said =
            refusal(scratch, evolve(config, directory, {"--resume", "--set", "evolution.generations=6"}));
        EXPECT_EQ(said.code, 1) << output;
        EXPECT_PRED1(is_one_line, said.line);
        EXPECT_EQ(file_text(manifest), before) << output;
        write_file_atomically(directory + output, std::string_view{whole});
    }
    Command again{scratch, evolve(config, directory, {"--resume"})};
    EXPECT_EQ(again.wait(), 0) << again.err();
    EXPECT_EQ(signature(again), signature(first));
}

TEST(Resume, in_another_world_is_refused_also_without_its_manifest) {
    Scratch const scratch;
    std::string const directory = scratch.file("maze"), config = scratch.file("maze.toml");
    write_file_atomically(config, std::string_view{"[world]\nlibrary = \"maze\"\n[episode]\nsteps = 100\n"
                                                   "[evolution]\npopulation = 8\nfounders = 8\ngenerations = 2\n"});
    Command first{scratch, evolve(config, directory)};
    ASSERT_EQ(first.wait(), 0) << first.err();
    std::filesystem::remove(directory + "/manifest.json");
    std::vector<std::string> const resume{program("lore-evolve"), "--out", directory, "--resume"};
    Refusal const said = refusal(scratch, resume + std::vector<std::string>{"--set", "world.library=collectball"});
    EXPECT_EQ(said.code, 2) << said.line;
    EXPECT_PRED1(is_one_line, said.line);
    Command again{scratch, resume};
    EXPECT_EQ(again.wait(), 0) << again.err();
}

TEST(Resume, without_its_manifest_takes_the_seed_of_its_checkpoint) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 12), directory = scratch.file("run");
    Command first{scratch, evolve(config, directory, {"--seed", "3"})};
    ASSERT_EQ(first.wait(), 0) << first.err();
    std::filesystem::remove(directory + "/manifest.json");
    Refusal const said = refusal(scratch, evolve(config, directory, {"--resume", "--seed", "4"}));
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.line, HasSubstr("it was started with --seed 3"));
    Command again{scratch, evolve(config, directory, {"--resume"})};
    EXPECT_EQ(again.wait(), 0) << again.err();
    EXPECT_EQ(signature(again), signature(first));
}

TEST(KnowledgeBase, that_does_not_fit_is_refused_with_the_reason) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 3);
    write_small_base(scratch.file("long"), 25, 1.83f);
    write_small_base(scratch.file("loose"), 20, 2.5f);
    write_small_base(scratch.file("fits"), 20, 1.83f);
    write_file_atomically(scratch.file("foreign"), "not a knowledge base at all");
    struct Case {
        char const* file;
        int code;
        char const* says;
    };
    for (Case const& one : {Case{"long", 2, "its windows have 25 steps, knowledge.window_length is 20"},
                            Case{"loose", 2, "its threshold is 2.5"}, Case{"foreign", 1, "it is not a file of Lore"},
                            Case{"missing", 2, "No such file"}}) {
        for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)}) {
            Refusal const said =
                refusal(scratch, launcher + evolve(config, scratch.file("run"), {"--kb", scratch.file(one.file)}));
            EXPECT_EQ(said.code, one.code) << said.line;
            EXPECT_THAT(said.line, HasSubstr(one.says));
            EXPECT_TRUE(is_one_line(said.line)) << said.line;
        }
        EXPECT_FALSE(exists(scratch.file("run"))) << "what is refused leaves nothing behind";
    }
    Refusal const idle =
        refusal(scratch, evolve(config, scratch.file("run"),
                                {"--kb", scratch.file("fits"), "--set", "evolution.use_shaping=false"}));
    EXPECT_EQ(idle.code, 2);
    EXPECT_THAT(idle.line, HasSubstr("leaves it without use"));
    EXPECT_FALSE(exists(scratch.file("run")));
    Command shaped{scratch, on_ranks(2) + evolve(config, scratch.file("run"), {"--kb", scratch.file("fits")})};
    EXPECT_EQ(shaped.wait(), 0) << shaped.err();
    EXPECT_THAT(file_text(scratch.file("run/config.toml")), HasSubstr("use_shaping = true"));
    EXPECT_THAT(file_text(scratch.file("run/manifest.json")), HasSubstr("knowledge base"));
    Refusal const unshaped =
        refusal(scratch, evolve(config, scratch.file("run"), {"--resume", "--set", "evolution.use_shaping=false"}));
    EXPECT_EQ(unshaped.code, 2);
    EXPECT_THAT(unshaped.line, HasSubstr("it was started with evolution.use_shaping = true"));
    std::filesystem::rename(scratch.file("fits"), scratch.file("moved"));
    Refusal const moved = refusal(scratch, evolve(config, scratch.file("run"), {"--resume"}));
    EXPECT_EQ(moved.code, 2);
    EXPECT_THAT(moved.line, HasSubstr("fits is not there any more"));
    Command found{scratch, evolve(config, scratch.file("run"), {"--resume", "--kb", scratch.file("moved")})};
    EXPECT_EQ(found.wait(), 0) << found.err();
    Refusal const without =
        refusal(scratch, evolve(config, scratch.file("without"), {"--set", "evolution.use_shaping=true"}));
    EXPECT_EQ(without.code, 2);
    EXPECT_THAT(without.line, HasSubstr("Give one with --kb"));
}
