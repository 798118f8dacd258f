// A wall clock that is set while a run goes on, by an administrator or by NTP, must not matter.

#include "system/evolve_command.h"

#include <gmock/gmock.h>

#include <ctime>

using namespace lore;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// Its words go in front of the program's.
std::vector<std::string> with_jumping_clock() {
    return {"env", "LD_PRELOAD=" JUMPING_CLOCK, "ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0"};
}

std::string this_year() {
    std::time_t const now = std::time(nullptr);
    return std::to_string(1900 + std::gmtime(&now)->tm_year);
}

}   // namespace

TEST(JumpingClock, changes_nothing_but_the_time_stamps) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 20);
    Command straight{scratch, evolve(config, scratch.file("straight"))};
    ASSERT_EQ(straight.wait(), 0) << straight.err();
    EXPECT_THAT(file_text(scratch.file("straight/manifest.json")), HasSubstr("\"" + this_year() + "-"));
    for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)}) {
        std::string const directory = scratch.file(std::to_string(launcher.size()));
        Command jumped{scratch,
                       launcher + with_jumping_clock() + evolve(config, directory, {"--max-time", "01:00:00"})};
        EXPECT_EQ(jumped.wait(), 0) << jumped.err();
        EXPECT_EQ(signature(jumped), signature(straight));
        EXPECT_EQ(results(directory), results(scratch.file("straight")));
        EXPECT_THAT(file_text(directory + "/manifest.json"), Not(HasSubstr("\"" + this_year() + "-")))
            << "the clock did not jump";
    }
}

TEST(JumpingClock, does_not_bring_the_time_limit_forward_or_put_it_off) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 1000000), directory = scratch.file("run");
    auto const start = std::chrono::steady_clock::now();
    Command command{scratch, with_jumping_clock() + evolve(config, directory, {"--max-time", "00:00:02"})};
    EXPECT_EQ(command.wait(), 75) << command.err();
    auto const took = std::chrono::steady_clock::now() - start;
    EXPECT_GE(took, std::chrono::seconds{2});
    EXPECT_LT(took, std::chrono::seconds{20});
}
