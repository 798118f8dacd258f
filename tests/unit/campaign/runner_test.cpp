#include <lore/campaign/board.h>
#include <lore/campaign/runner.h>

#include <lore/campaign/choice.h>
#include <lore/campaign/stop_signals.h>

#include "campaign_fixture.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <set>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace lore;

class Runner : public test::CampaignTest {
protected:
    /// Works on the campaign in a process of its own, which tests can signal and kill.
    pid_t run_elsewhere(int jobs = 2) {
        pid_t const pid = ::fork();
        if (pid == 0) ::_exit(static_cast<int>(run_campaign(plan(), directory(), options(jobs))));
        return pid;
    }
    static int exit_code_of(pid_t pid) {
        int status = 0;
        ::waitpid(pid, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    void wait_for(std::string const& file) const {
        for (int i = 0; i < 400 && !std::filesystem::exists(file); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds{25});
    }
    /// Every run's progress and every knowledge base, by path.
    std::map<std::string, std::string> products(std::string const& where) const {
        std::map<std::string, std::string> files;
        for (auto const& entry : std::filesystem::recursive_directory_iterator(scratch.file(where))) {
            std::string const name = entry.path().filename().string();
            if (name == "choice.json" || name == "lineage.lore")
                files[std::filesystem::relative(entry.path(), scratch.file(where)).string()] = read(entry.path());
            if (name == "progress.csv") {
                // Times differ from run to run: the last column is left out.
                std::string text;
                std::ifstream file{entry.path()};
                for (std::string line; std::getline(file, line);) text += line.substr(0, line.rfind(',')) + "\n";
                files[std::filesystem::relative(entry.path(), scratch.file(where)).string()] = text;
            }
        }
        return files;
    }
    int starts() const {
        return static_cast<int>(std::distance(std::filesystem::directory_iterator{scratch.file("starts")}, {}));
    }
    void count_starts() const {
        std::filesystem::create_directories(scratch.file("starts"));
        ::setenv("LORE_FAKE_COUNT", scratch.file("starts").c_str(), 1);
    }
};

TEST_F(Runner, works_through_a_campaign_and_starts_nothing_the_second_time) {
    count_starts();
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    for (Step const& step : steps_of(plan()))
        EXPECT_EQ(state(step.name).status, StepStatus::done) << step.name << ": " << state(step.name).reason;
    EXPECT_EQ(starts(), 4 + 1 + 9);
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(starts(), 4 + 1 + 9);
}

TEST_F(Runner, tries_a_failed_run_once_more) {
    ::setenv("LORE_FAKE_FAIL", "source:2:1", 1);
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("source/002").status, StepStatus::done);
}

TEST_F(Runner, reports_a_run_that_fails_twice_and_goes_on_with_the_others) {
    ::setenv("LORE_FAKE_FAIL", "kb1:2:9", 1);
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::failure);
    std::string const said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("kb1/002 failed twice (exit code 1)"), std::string::npos) << said;
    EXPECT_NE(said.find("the fake fails (it was told to)"), std::string::npos) << said;
    EXPECT_EQ(state("kb1/002").status, StepStatus::failed);
    EXPECT_EQ(state("kb1/001").status, StepStatus::done);
    EXPECT_EQ(state("kb1/003").status, StepStatus::done);
    EXPECT_EQ(state("all/003").status, StepStatus::done);

    ::unsetenv("LORE_FAKE_FAIL");   // mended: the next call makes it
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(state("kb1/002").status, StepStatus::done);
}

TEST(Board, shows_what_a_log_says_and_not_what_a_terminal_would_obey) {
    testing::internal::CaptureStderr();
    Board{true}.complain("    it said \033[2J");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "    it said ?[2J\n");
}

TEST_F(Runner, does_not_try_again_what_was_refused_as_wrongly_configured) {
    ::setenv("LORE_FAKE_FAIL", "kb1:2:1:2", 1);   // a second attempt would succeed
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::failure);
    std::string const said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("kb1/002 failed (exit code 2)"), std::string::npos) << said;
    EXPECT_EQ(state("kb1/002").status, StepStatus::failed);
    EXPECT_TRUE(state("kb1/002").reason.starts_with("exit code 2 after 1 attempt: ")) << state("kb1/002").reason;
}

TEST_F(Runner, chooses_without_source_runs_that_failed) {
    ::setenv("LORE_FAKE_FAIL", "source:1:9", 1);
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::failure);
    testing::internal::GetCapturedStderr();
    EXPECT_EQ(read_choice(directory().choice()).without, std::vector<int>{1});
    EXPECT_EQ(state("kb1/003").status, StepStatus::done);
}

TEST_F(Runner, chooses_only_once_every_source_run_has_ended_wherever_it_runs) {
    RunnerOptions only = options();
    only.only = {"source/001", "source/002", "source/003"};
    ASSERT_EQ(run_campaign(plan(), directory(), only), ExitCode::done);
    only.only = {"choose"};
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::failure);
    EXPECT_TRUE(testing::internal::GetCapturedStderr().starts_with("choose cannot be done: it waits for source/004"));
    EXPECT_EQ(state("choose").status, StepStatus::missing);

    ::setenv("LORE_FAKE_FAIL", "source:4:9", 1);
    only.only = {"source/004"};
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::failure);
    testing::internal::GetCapturedStderr();
    only.only = {"choose"};
    EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::done) << "what has failed has ended";
}

TEST_F(Runner, keeps_why_it_could_not_choose_and_draws_no_pictures_of_runs_not_chosen) {
    write("campaign.toml", test::small_campaign + "trajectory = \"kb1\"\n");
    ::setenv("LORE_FAKE_FAIL", "source:1:9,source:2:9,source:3:9,source:4:9", 1);
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::failure);
    std::string const said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("\nreplay cannot be done: it waits for choose\n"), std::string::npos) << said;
    EXPECT_EQ(state("choose").status, StepStatus::failed);
    EXPECT_NE(state("choose").reason.find("no source run is left for 'kb1'"), std::string::npos);
    EXPECT_EQ(state("replay").status, StepStatus::missing);
}

TEST_F(Runner, takes_no_outdated_choice_though_choosing_has_failed_before) {
    RunnerOptions only = options();
    only.only = {"source", "choose"};
    ASSERT_EQ(run_campaign(plan(), directory(), only), ExitCode::done);
    std::string const taken = std::to_string(read_choice(directory().choice()).of("kb1").run);
    auto const choose_with = [&](std::string const& from, std::string const& to) {
        write("campaign.toml",
              std::string{test::small_campaign}.replace(test::small_campaign.find(from), from.size(), to));
        testing::internal::CaptureStderr();
        EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::failure);
        return testing::internal::GetCapturedStderr();
    };
    std::string const twice =
        choose_with("[[treatment]]", "[[knowledge]]\nname = \"kb3\"\nrun = " + taken + "\n[[treatment]]");
    EXPECT_NE(twice.find("cannot take source run " + taken + " for 'kb3'"), std::string::npos) << twice;
    std::string const other = choose_with("balls = 6", "balls = 1");
    EXPECT_NE(other.find("'kb1' comes from run " + taken + ", which is not what the campaign asks for now"),
              std::string::npos)
        << other;
}

TEST_F(Runner, starts_runs_of_one_rank_in_an_allocation_of_several_tasks) {
    ::setenv("SLURM_NTASKS", "8", 1);   // lore-evolve refuses to be one of eight that do not find each other
    RunnerOptions only = options();
    only.only = {"none/001"};
    EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::done);
    EXPECT_EQ(std::getenv("SLURM_NTASKS"), nullptr) << "what it starts does not see it";
}

TEST_F(Runner, goes_on_at_a_hang_up_under_nohup) {
    auto* const before = std::signal(SIGHUP, SIG_IGN);
    {
        StopSignals const signals;
        std::raise(SIGHUP);
        signals.sleep(0);
        EXPECT_EQ(signals.requests(), 0);
    }
    std::signal(SIGHUP, SIG_DFL);
    {
        StopSignals const signals;
        std::raise(SIGHUP);
        signals.sleep(0);
        EXPECT_EQ(signals.requests(), 1);
    }
    std::signal(SIGHUP, before);
}

TEST_F(Runner, says_what_cannot_be_done_when_its_knowledge_base_fails) {
    ::setenv("LORE_FAKE_FAIL", "archive:1:9,archive:2:9,archive:3:9,archive:4:9", 1);
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::failure);
    EXPECT_NE(testing::internal::GetCapturedStderr().find(
                  "all/001 to all/003 cannot be done: they wait for knowledge/kb1_all\n"),
              std::string::npos);
    EXPECT_EQ(state("kb1/003").status, StepStatus::done);
    EXPECT_EQ(state("all/001").status, StepStatus::missing);
}

TEST_F(Runner, works_only_on_the_steps_it_is_told) {
    RunnerOptions only = options();
    only.only = {"source/002", "none"};
    EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::done);
    EXPECT_EQ(state("source/002").status, StepStatus::done);
    EXPECT_EQ(state("none/003").status, StepStatus::done);
    EXPECT_EQ(state("source/001").status, StepStatus::missing);
    only.only = {"nine"};
    EXPECT_THROW(run_campaign(plan(), directory(), only), UsageError);
}

TEST_F(Runner, says_once_a_treatment_that_its_steps_wait_for_what_it_is_not_told_to_do) {
    RunnerOptions only = options();
    only.only = {"kb1", "all/002"};
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), only), ExitCode::failure);
    EXPECT_EQ(
        testing::internal::GetCapturedStderr(),
        "kb1/001 to kb1/003 cannot be done: they wait for knowledge/kb1, which is not done and not among the steps "
        "named by --only\n"
        "all/002 cannot be done: it waits for knowledge/kb1_all, which is not done and not among the steps named by "
        "--only\n");
}

TEST_F(Runner, stops_at_a_checkpoint_when_asked_and_ends_with_the_same_files_when_called_again) {
    ASSERT_EQ(run_campaign(plan(), directory("straight"), options()), ExitCode::done);
    ::setenv("LORE_FAKE_MS", "20", 1);
    pid_t const pid = run_elsewhere();
    wait_for(scratch.file("c/runs/source/001/progress.csv"));
    std::this_thread::sleep_for(std::chrono::milliseconds{100});
    ::kill(pid, SIGINT);
    EXPECT_EQ(exit_code_of(pid), static_cast<int>(ExitCode::interrupted));
    EXPECT_EQ(state("source/001").status, StepStatus::interrupted);
    EXPECT_GT(state("source/001").generation, 0);
    ::setenv("LORE_FAKE_MS", "0", 1);
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(products("c"), products("straight"));
}

TEST_F(Runner, ends_with_the_same_files_after_being_killed_at_any_moment) {
    ASSERT_EQ(run_campaign(plan(), directory("straight"), options()), ExitCode::done);
    ::setenv("LORE_FAKE_MS", "5", 1);
    for (int const after : {30, 80, 150, 400}) {
        pid_t const pid = run_elsewhere();
        std::this_thread::sleep_for(std::chrono::milliseconds{after});
        ::kill(pid, SIGKILL);   // its runs go on, and keep their steps locked
        exit_code_of(pid);
    }
    EXPECT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(products("c"), products("straight"));
}

TEST_F(Runner, lets_two_copies_share_the_work_without_making_anything_twice) {
    count_starts();
    ::setenv("LORE_FAKE_MS", "3", 1);
    pid_t const first = run_elsewhere(1), second = run_elsewhere(1);
    EXPECT_EQ(exit_code_of(first), 0);
    EXPECT_EQ(exit_code_of(second), 0);
    EXPECT_EQ(starts(), 4 + 1 + 9);
}

TEST_F(Runner, says_when_a_program_is_missing) {
    RunnerOptions nowhere = options();
    nowhere.launcher.programs = scratch.file("nowhere");
    nowhere.only = {"source/001"};
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_campaign(plan(), directory(), nowhere), ExitCode::failure);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("cannot start"), std::string::npos);
}

TEST_F(Runner, kills_a_launcher_that_outlives_its_ranks_and_makes_the_run_again) {
    // Once for each of its runs it kills its rank, never asks how that ended, and waits for ever.
    write("launcher", "#!/bin/sh\n"
                      "hung=$(dirname $0)/hung-$(echo \"$*\" | cksum | cut -d' ' -f1)\n"
                      "\"$@\" & rank=$!\n"
                      "if [ -e \"$hung\" ]; then wait $rank; exit $?; fi\n"
                      "touch \"$hung\"; sleep 2; kill -9 $rank; exec sleep 600\n");
    std::filesystem::permissions(scratch.file("launcher"), std::filesystem::perms::owner_all);
    ::setenv("LORE_FAKE_MS", "200", 1);
    RunnerOptions launched = options();
    launched.launcher.ranks = 2;
    launched.launcher.launch = scratch.file("launcher");
    launched.launcher_patience = 0.5;
    launched.only = {"source/001", "source/002"};
    EXPECT_EQ(run_campaign(plan(), directory(), launched), ExitCode::done);
    EXPECT_EQ(state("source/001").status, StepStatus::done);
    EXPECT_EQ(state("source/002").status, StepStatus::done);
    EXPECT_NE(read(directory().log("source/001")).find("has had no living rank for 0.5 s, and was killed"),
              std::string::npos);
}

TEST_F(Runner, takes_the_result_of_a_run_whose_launcher_hangs_after_it) {
    write("launcher", "#!/bin/sh\n\"$@\" & wait $!\nexec sleep 600\n");
    std::filesystem::permissions(scratch.file("launcher"), std::filesystem::perms::owner_all);
    count_starts();
    ::setenv("LORE_FAKE_MS", "100", 1);   // long enough to be seen alive
    RunnerOptions launched = options();
    launched.launcher.ranks = 2;
    launched.launcher.launch = scratch.file("launcher");
    launched.launcher_patience = 0.5;
    launched.only = {"source/001"};
    EXPECT_EQ(run_campaign(plan(), directory(), launched), ExitCode::done);
    EXPECT_EQ(starts(), 1);
}
