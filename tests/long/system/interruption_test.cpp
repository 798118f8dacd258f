// Signals, time limits, evaluations that fail: a run stops at a checkpoint or says what happened, and never hangs.

#include "system/evolve_command.h"

#include <lore/archive/genome_file.h>

#include <gmock/gmock.h>

#include <algorithm>

using namespace lore;
using ::testing::HasSubstr;

namespace {

constexpr int endless = 1000000;

bool has_generations(std::string const& directory) { return timeless_progress(directory).size() > 400; }

}   // namespace

TEST(Signals, stop_a_run_at_a_checkpoint_with_exit_code_75) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless);
    for (int const number : {SIGUSR1, SIGUSR2, SIGTERM, SIGINT, SIGXCPU}) {
        std::string const directory = scratch.file(std::to_string(number));
        Command command{scratch, evolve(config, directory)};
        ASSERT_TRUE(command.wait_until([&] { return has_generations(directory); })) << command.err();
        command.signal(number);
        EXPECT_EQ(command.wait(), 75) << number << command.err();
        EXPECT_TRUE(exists(directory + "/checkpoint.lore"));
        EXPECT_TRUE(exists(directory + "/lineage.lore"));
        EXPECT_THAT(command.err(), HasSubstr("go on with --resume"));
        EXPECT_THAT(file_text(directory + "/manifest.json"), HasSubstr("\"status\": \"interrupted\""));
        EXPECT_EQ(command.out(), "");
    }
}

TEST(Signals, sent_to_mpirun_stop_all_ranks_with_exit_code_75) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless);
    for (int const number : {SIGUSR1, launcher_is_mpich ? SIGTERM : SIGUSR2}) {
        std::string const directory = scratch.file(std::to_string(number));
        Command command{scratch, on_ranks(2) + evolve(config, directory)};
        ASSERT_TRUE(command.wait_until([&] { return has_generations(directory); })) << command.err();
        command.signal(number);
        int const code = command.wait();
        EXPECT_TRUE(code == 75 || (launcher_is_mpich && code == 0)) << number << ": " << code << command.err();
        EXPECT_TRUE(exists(directory + "/checkpoint.lore"));
        EXPECT_THAT(file_text(directory + "/manifest.json"), HasSubstr("\"status\": \"interrupted\"")) << number;
    }
}

TEST(Signals, that_make_mpirun_kill_its_ranks_leave_a_checkpoint) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless);
    for (int const number : {SIGTERM, SIGINT}) {
        std::string const directory = scratch.file(std::to_string(number));
        // Open MPI's second is not enough for a checkpoint on every busy machine.
        Command command{scratch, std::vector<std::string>{"OMPI_MCA_odls_base_sigkill_timeout=3"} + on_ranks(2) +
                                     evolve(config, directory)};
        ASSERT_TRUE(command.wait_until([&] { return has_generations(directory); })) << command.err();
        command.signal(number);
        int const code = command.wait();
        EXPECT_TRUE(code != 0 || launcher_is_mpich) << number;
        EXPECT_THAT(file_text(directory + "/manifest.json"), HasSubstr("\"status\": \"interrupted\"")) << number;
    }
}

TEST(Signals, of_a_cpu_limit_may_repeat_before_the_generation_ends) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless), directory = scratch.file("run");
    Command command{scratch, std::vector<std::string>{"LORE_TEST_DELAY=150"} +
                                 evolve(config, directory)};   // more than a second a generation
    ASSERT_TRUE(command.wait_until([&] { return exists(directory + "/progress.csv"); }));
    for (int repeat = 0; repeat < 10 && command.running(); ++repeat) {   // the kernel: once a second of processor time
        command.signal(SIGXCPU);
        std::this_thread::sleep_for(std::chrono::milliseconds{600});
    }
    EXPECT_EQ(command.wait(), 75) << command.err();
    EXPECT_TRUE(exists(directory + "/checkpoint.lore"));
}

TEST(Signals, end_a_run_at_once_when_one_comes_again_later) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless), directory = scratch.file("twice");
    // Every batch takes up to ten seconds, so that no generation ends in between.
    Command command{scratch, std::vector<std::string>{"LORE_TEST_DELAY=10000"} + evolve(config, directory)};
    ASSERT_TRUE(command.wait_until([&] { return exists(directory + "/progress.csv"); }));
    command.signal(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds{800});
    command.signal(SIGTERM);
    EXPECT_EQ(command.wait(), 128 + SIGTERM);
}

TEST(TimeLimit, stops_a_run_at_a_checkpoint_with_exit_code_75) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless);
    for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)}) {
        std::string const directory = scratch.file(std::to_string(launcher.size()));
        Command command{scratch, launcher + evolve(config, directory, {"--max-time", "00:00:01"})};
        EXPECT_EQ(command.wait(), 75) << command.err();
        EXPECT_TRUE(exists(directory + "/checkpoint.lore"));
        EXPECT_THAT(command.err(), HasSubstr("time limit"));
    }
}

TEST(FailedEvaluation, ends_all_ranks_names_the_individual_and_keeps_its_genome) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless);
    struct Case {
        int ranks, failing;
        char const* how;
        char const* reason;
    };
    for (Case const& one :
         {Case{1, 0, "", "a failure that the test asked for"}, Case{2, 0, "", "a failure that the test asked for"},
          Case{2, 1, "", "a failure that the test asked for"}, Case{3, 2, ":memory", "out of memory"}}) {
        std::string const id = std::to_string(one.ranks) + "-" + std::to_string(one.failing),
                          directory = scratch.file(id);
        auto const launcher = one.ranks == 1 ? std::vector<std::string>{} : on_ranks(one.ranks);
        Command command{scratch,
                        std::vector<std::string>{"LORE_TEST_FAIL=" + std::to_string(one.failing) + ":5" + one.how} +
                            launcher + evolve(config, directory)};
        EXPECT_EQ(command.wait(), 1) << id << command.err();
        EXPECT_THAT(command.err(), HasSubstr("failed on rank " + std::to_string(one.failing))) << id;
        EXPECT_THAT(command.err(), HasSubstr(one.reason)) << id;
        FailedIndividual const failed = read_genome(directory + "/failed-genome.lore");
        EXPECT_EQ(failed.rank, one.failing);
        EXPECT_THAT(command.err(), HasSubstr("individual " + std::to_string(failed.id.generation) + "." +
                                             std::to_string(failed.id.slot)))
            << id;
        EXPECT_GE(failed.genome.edges.size(), 30u);
        // It did not fail for what it is.
        Command again{scratch,
                      {program("lore-replay"), directory, "--individual", "failed", "--out", directory + "/again"}};
        EXPECT_EQ(again.wait(), 0) << again.err();
        EXPECT_THAT(again.out(), HasSubstr("individual " + std::to_string(failed.id.generation)));
        EXPECT_TRUE(exists(directory + "/again/trajectory.svg"));
    }
}

TEST(FailedEvaluation, ends_all_ranks_of_a_bench_too) {
    Scratch const scratch;
    Command command{scratch, std::vector<std::string>{"LORE_TEST_FAIL=1:3"} + on_ranks(2) +
                                 std::vector<std::string>{program("lore-evolve"), "--bench"}};
    EXPECT_EQ(command.wait(), 1);
    EXPECT_THAT(command.err(), HasSubstr("a failure that the test asked for"));
}

TEST(KilledRank, ends_the_whole_job_within_seconds) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless), directory = scratch.file("run");
    Command command{scratch, on_ranks(2) + evolve(config, directory)};
    ASSERT_TRUE(command.wait_until([&] { return exists(directory + "/checkpoint.lore"); })) << command.err();
    auto const ranks = ranks_of(command.pid());
    ASSERT_EQ(ranks.size(), 2u);
    ::kill(ranks.back(), SIGKILL);
    auto const start = std::chrono::steady_clock::now();
    EXPECT_NE(command.wait(), 0);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{10});
    EXPECT_TRUE(exists(directory + "/checkpoint.lore"));
}

TEST(DamagedMessage, ends_all_ranks_within_seconds) {
    Scratch const scratch;
    std::string const config = small_config(scratch, endless), directory = scratch.file("run");
    Command command{scratch,
                    std::vector<std::string>{"LORE_TEST_FAIL=1:20:reply"} + on_ranks(3) + evolve(config, directory)};
    auto const start = std::chrono::steady_clock::now();
    EXPECT_EQ(command.wait(), 1);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{20});
    EXPECT_THAT(command.err(), HasSubstr("a message with evaluations"));
    EXPECT_FALSE(exists(directory + "/failed-genome.lore")) << "no genome is to blame";
}

TEST(OutOfMemory, in_the_midst_of_evolution_ends_all_ranks_with_one_line) {
#if defined(LORE_SANITIZED)
    GTEST_SKIP() << "sanitizers want all of the address space";
#else
    Scratch const scratch;
    std::string const config = small_config(scratch, endless);
    for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)}) {
        // The Hamming distances among 60 000 would take 14 GB.
        std::vector<std::string> const with_limit{"bash", "-c", "ulimit -v 900000; exec \"$@\"", "-"};
        std::string const directory = scratch.file(std::to_string(launcher.size()));
        Command command{scratch, with_limit + launcher +
                                     evolve(config, directory,
                                            {"--set", "evolution.population=20000", "--set", "evolution.founders=60000",
                                             "--set", "episode.steps=20", "--set", "diversity.distances=hamming"})};
        EXPECT_EQ(command.wait(), 1);
        EXPECT_THAT(command.err(), HasSubstr("failed in generation 0 (out of memory)"));
        EXPECT_EQ(std::ranges::count(command.err(), '\n'), 1) << command.err();
    }
#endif
}
