#include <campaign/launcher_watch.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace lore;

class Launcher : public ::testing::Test {
protected:
    /// Whether the launcher hangs `seconds` after the start of the watch.
    bool hangs(Ranks ranks, int seconds) { return watch.hangs(ranks, start + std::chrono::seconds{seconds}); }

    static constexpr Ranks none{0, 0}, living{2, 0}, dead{0, 2};
    LauncherWatch watch{std::chrono::seconds{10}};
    LauncherWatch::Clock::time_point const start{};
};

TEST_F(Launcher, hangs_once_it_has_been_without_ranks_for_its_patience) {
    EXPECT_FALSE(hangs(living, 0));
    EXPECT_FALSE(hangs(none, 100));
    EXPECT_FALSE(hangs(none, 109));
    EXPECT_TRUE(hangs(none, 110));
}

TEST_F(Launcher, hangs_with_ranks_that_are_all_dead) {
    EXPECT_FALSE(hangs(dead, 0));
    EXPECT_TRUE(hangs(dead, 10));
}

TEST_F(Launcher, does_not_hang_before_its_first_rank) {
    EXPECT_FALSE(hangs(none, 0));
    EXPECT_FALSE(hangs(none, 1000));
}

TEST_F(Launcher, is_given_its_whole_patience_again_after_each_sight_of_a_rank) {
    EXPECT_FALSE(hangs(living, 0));
    EXPECT_FALSE(hangs(none, 1));
    EXPECT_FALSE(hangs(living, 10));
    EXPECT_FALSE(hangs(none, 12));
    EXPECT_FALSE(hangs(none, 21));
    EXPECT_TRUE(hangs(none, 22));
}

TEST(Ranks, are_descendants_of_a_name_and_dead_as_soon_as_they_are_zombies) {
    pid_t const child = ::fork();
    if (child == 0) {
        ::prctl(PR_SET_NAME, "a (rank) of us");
        for (;;) ::pause();
    }
    auto const seen = [] { return ranks_of(::getpid(), "a (rank) of us"); };
    for (int i = 0; i < 400 && seen().living == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds{5});
    EXPECT_EQ(seen().living, 1);
    EXPECT_EQ(seen().dead, 0);
    EXPECT_EQ(ranks_of(::getpid(), "another").living, 0);
    ::kill(child, SIGKILL);
    siginfo_t end{};
    ::waitid(P_PID, static_cast<id_t>(child), &end, WEXITED | WNOWAIT);   // dead, and still a zombie
    EXPECT_EQ(seen().living, 0);
    EXPECT_EQ(seen().dead, 1);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(seen().dead, 0);
}
