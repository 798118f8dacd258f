// The signature of a run does not depend on ranks, delays, instruction set, or how often it was interrupted.

#include "system/evolve_command.h"

#include <lore/core/isa.h>
#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <cstdlib>

using namespace lore;

namespace {

/// What `lore-evolve --bench` prints. A change of it changes every result of Lore, and belongs into CHANGELOG.md.
constexpr char stored_bench_signature[] = "ab7de7b19cc073ee";

/// A straight run alone: what all others must equal.
struct Straight {
    Scratch const& scratch;
    std::string config, directory, signature;
    explicit Straight(Scratch const& s, int generations)
        : scratch(s), config(small_config(s, generations)), directory(s.file("straight")) {
        Command command{s, evolve(config, directory, {"--seed", "5"})};
        EXPECT_EQ(command.wait(), 0) << command.err();
        signature = lore::signature(command);
        EXPECT_EQ(signature.size(), 16u) << command.out();
    }
};

/// "LORE_ISA=..." of one that this machine has.
std::vector<std::string> any_instruction_set(Stream& rng) {
    Isa const sets[]{Isa::baseline, Isa::v3, Isa::v4};
    return {"LORE_ISA=" + std::string{name(sets[rng.below(static_cast<std::uint32_t>(detected_isa()) + 1)])}};
}

/// Nothing for a run alone.
std::vector<std::string> launcher_for(int ranks) { return ranks == 1 ? std::vector<std::string>{} : on_ranks(ranks); }

/// So often a rank is killed. tests/long/faults asks for more.
int kills_wanted() {
    char const* const asked = std::getenv("LORE_TEST_KILLS");
    return asked == nullptr ? 5 : std::atoi(asked);
}

}   // namespace

TEST(Determinism, ranks_and_delays_do_not_change_a_run) {
    Scratch const scratch;
    Straight const straight{scratch, 20};
    for (int ranks : {1, 2, 3, 4, 5}) {
        std::string const directory = scratch.file(std::to_string(ranks));
        Command command{scratch, std::vector<std::string>{"LORE_TEST_DELAY=2"} + on_ranks(ranks) +
                                     evolve(straight.config, directory, {"--seed", "5"})};
        EXPECT_EQ(command.wait(), 0) << command.err();
        EXPECT_EQ(signature(command), straight.signature) << ranks;
        EXPECT_EQ(results(directory), results(straight.directory)) << ranks;
    }
}

TEST(Determinism, how_ranks_wait_for_messages_does_not_change_a_run) {
    Scratch const scratch;
    Straight const straight{scratch, 10};
    for (char const* const waiting : {"LORE_WAITING=poll", "LORE_WAITING=sleep"}) {
        std::string const directory = scratch.file(waiting);
        Command command{scratch, std::vector<std::string>{waiting} + on_ranks(3) +
                                     evolve(straight.config, directory, {"--seed", "5"})};
        EXPECT_EQ(command.wait(), 0) << command.err();
        EXPECT_EQ(signature(command), straight.signature) << waiting;
    }
}

TEST(Determinism, another_seed_is_another_run) {
    Scratch const scratch;
    Straight const straight{scratch, 5};
    Command command{scratch, evolve(straight.config, scratch.file("other"), {"--seed", "6"})};
    EXPECT_EQ(command.wait(), 0);
    EXPECT_NE(signature(command), straight.signature);
}

TEST(Determinism, every_instruction_set_and_compiler_gives_the_stored_bench_signature) {
    Scratch const scratch;
    for (Isa isa : {Isa::baseline, Isa::v3, Isa::v4}) {
        if (isa > detected_isa()) continue;
        Command command{scratch, {"LORE_ISA=" + std::string{name(isa)}, program("lore-evolve"), "--bench"}};
        EXPECT_EQ(command.wait(), 0) << command.err();
        EXPECT_EQ(signature(command), stored_bench_signature) << name(isa);
    }
}

TEST(Determinism, two_runs_at_once_do_not_disturb_each_other) {
    Scratch const scratch;
    Straight const straight{scratch, 20};
    Command first{scratch, on_ranks(2) + evolve(straight.config, scratch.file("a"), {"--seed", "5"})};
    Command second{scratch, on_ranks(2) + evolve(straight.config, scratch.file("b"), {"--seed", "5"})};
    EXPECT_EQ(first.wait(), 0) << first.err();
    EXPECT_EQ(second.wait(), 0) << second.err();
    EXPECT_EQ(signature(first), straight.signature);
    EXPECT_EQ(signature(second), straight.signature);
}

TEST(Resume, after_stops_at_random_moments_on_other_ranks_and_instruction_sets_ends_with_the_same_bytes) {
    Scratch const scratch;
    Straight const straight{scratch, 60};
    Stream rng{1, Purpose::test};
    std::string const directory = scratch.file("resumed");
    int stops = 0, code = 75;
    std::string last;
    for (int session = 0; session < 40 && code == 75; ++session) {
        auto const start = any_instruction_set(rng) + std::vector<std::string>{"LORE_TEST_DELAY=3"} +
                           launcher_for(1 + static_cast<int>(rng.below(3)));
        Command command{scratch, start + evolve(straight.config, directory, {"--seed", "5", "--resume"})};
        std::string const before = timeless_progress(directory);
        std::size_t const wanted = before.size() + rng.below(1800);
        bool const reached = command.wait_until([&] { return timeless_progress(directory).size() > wanted; });
        if (reached && command.running()) command.signal(SIGUSR1);
        code = command.wait();
        ASSERT_TRUE(code == 0 || code == 75) << code << command.err();
        last = signature(command);
        if (launcher_is_mpich && last.empty()) code = 75;   // after a signal its launcher may say 0
        if (code == 75) ++stops;
    }
    EXPECT_GT(stops, 2);
    EXPECT_EQ(last, straight.signature);
    EXPECT_EQ(results(directory), results(straight.directory));
}

TEST(Resume, after_kill_9_of_a_random_rank_at_random_moments_ends_with_the_same_bytes) {
    Scratch const scratch;
    int const wanted = kills_wanted();
    Straight const straight{scratch, 12 * wanted};
    Stream rng{2, Purpose::test};
    std::string const directory = scratch.file("killed");
    int kills = 0, code = -1;
    std::string last;
    for (int session = 0; session < 4 * wanted && code != 0; ++session) {
        int const ranks = 1 + static_cast<int>(rng.below(3));
        auto const start =
            any_instruction_set(rng) + std::vector<std::string>{"LORE_TEST_DELAY=15"} + launcher_for(ranks);
        Command command{scratch, start + evolve(straight.config, directory, {"--seed", "5", "--resume"})};
        if (kills < wanted) {
            // One in five while the ranks still start; the others at any moment after the next generation.
            std::string const before = timeless_progress(directory);
            auto const living = [&] { return ranks == 1 ? std::vector{command.pid()} : ranks_of(command.pid()); };
            if (rng.below(5) != 0) command.wait_until([&] { return timeless_progress(directory) != before; });
            else command.wait_until([&] { return !living().empty(); });
            std::this_thread::sleep_for(std::chrono::milliseconds{rng.below(300)});
            auto const victims = living();
            if (!victims.empty() &&
                ::kill(victims[rng.below(static_cast<std::uint32_t>(victims.size()))], SIGKILL) == 0)
                ++kills;
        }
        code = command.wait();
        last = signature(command);
    }
    EXPECT_EQ(kills, wanted);
    EXPECT_EQ(code, 0);
    EXPECT_EQ(last, straight.signature);
    EXPECT_EQ(results(directory), results(straight.directory));
}

TEST(Resume, goes_on_beyond_the_end_when_more_generations_are_asked_for) {
    Scratch const scratch;
    Straight const straight{scratch, 30};
    std::string const config = small_config(scratch, 12), directory = scratch.file("longer");
    Command first{scratch, evolve(config, directory, {"--seed", "5"})};
    EXPECT_EQ(first.wait(), 0) << first.err();
    Command second{scratch,
                   {program("lore-evolve"), "--resume", "--out", directory, "--set", "evolution.generations=30", "-q"}};
    EXPECT_EQ(second.wait(), 0) << second.err();
    EXPECT_EQ(signature(second), straight.signature);
    EXPECT_EQ(timeless_progress(directory), timeless_progress(straight.directory));
    Command third{scratch, {program("lore-evolve"), "--resume", "--out", directory, "-q"}};
    EXPECT_EQ(third.wait(), 0) << "a finished run has nothing to do: " << third.err();
    EXPECT_EQ(signature(third), straight.signature);
}
