#include <lore/world/library.h>

#include "support/c_worlds.h"
#include "support/complaint.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <map>
#include <vector>

namespace lore {
namespace {

using test::c_world;
using test::complaint_of;
using test::trial_world;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

/// Steps a batch of three until the library is told off, or 30 steps have gone by.
std::string complaint_of_stepping(std::string const& fault) {
    return complaint_of([&] {
        auto const world = trial_world(fault);
        auto const lives = world->begin_lives(3);
        std::array<float, 9> sensors{};
        std::array<float, 3> x{}, y{}, rewards{}, outcomes{};
        std::array<unsigned char, 3> over{};
        std::array<float, 6> const effectors{0.5f, 0.75f, 1, 1, 0, 1};
        for (int step = 0; step < 30; ++step) {
            lives->sense(sensors, x, y);
            lives->act(effectors, rewards, over);
        }
        lives->outcome(outcomes);
    });
}

TEST(Library, tells_its_facts) {
    auto const world = trial_world();
    WorldFacts const& facts = world->facts();
    EXPECT_EQ(facts.name, "trial");
    EXPECT_EQ(facts.task, "plain");
    EXPECT_EQ(facts.reward_unit, "pushes");
    EXPECT_EQ(facts.sensors, (std::vector<ChannelInfo>{{"phase", false}, {"flag", true}, {"echo", false}}));
    EXPECT_EQ(facts.effectors, (std::vector<ChannelInfo>{{"push", false}, {"grip", true}}));
    EXPECT_EQ(facts.outcome_size, 1);
    EXPECT_EQ(facts.max_batch, 64);
    EXPECT_EQ(facts.width, 2);
    EXPECT_EQ(world->scene_svg(), "<g><circle r=\"1\"/></g>");
}

TEST(Library, gives_a_life_what_it_gives_a_batch) {
    auto const world = trial_world();
    auto const life = world->begin();
    auto const lives = world->begin_lives(2);
    std::array<float, 3> sensors{};
    std::array<float, 6> both{};
    std::array<float, 2> x{}, y{}, rewards{}, outcomes{};
    std::array<unsigned char, 2> over{};
    for (int step = 0; step < 700; ++step) {
        float const push = static_cast<float>(step % 7) / 7;
        Position const at = life->sense(sensors);
        lives->sense(both, x, y);
        ASSERT_EQ(sensors, (std::array{both[1], both[3], both[5]}));
        ASSERT_EQ(at, (Position{x[1], y[1]}));
        bool const was_over = over[1] != 0;
        lives->act(std::array{0.0f, push, 0.0f, 1.0f}, rewards, over);
        if (was_over) continue;
        StepResult const result = life->act(std::array{push, 1.0f});
        ASSERT_EQ(result, (StepResult{rewards[1], over[1] != 0}));
    }
    EXPECT_EQ(over, (std::array<unsigned char, 2>{0, 1})) << "the second life had had its steps";
    std::array<float, 1> outcome{};
    life->outcome(outcome);
    lives->outcome(outcomes);
    EXPECT_EQ(outcome[0], outcomes[1]);
}

TEST(Library, is_told_off_for_a_wrong_value_with_its_place_and_number) {
    EXPECT_EQ(complaint_of_stepping(""), "");
    std::map<std::string, std::string> const told{
        {"nan_sensor", "step 17 (sensor 'phase' of life 2 is NaN"},
        {"sensor_range", "step 17 (sensor 'echo' of life 2 is 1.25, and sensors lie in [0, 1]"},
        {"binary", "step 17 (binary sensor 'flag' of life 2 is 0.25"},
        {"position", "step 17 (x of life 2 is -3, and positions lie in 0 .. width = 2"},
        {"infinite_reward", "step 16 (the reward of life 0 is inf"},
        {"over", "step 16 (over of life 0 is 2"},
        {"revives", "(life 0 is not over, and was before"},
        {"outcome", "step 30 (outcome 0 of life 0 is NaN"},
        {"unwritten", "step 0 (sensor 'echo' of life 2 is NaN, or was not written"},
        {"overrun", "step 0 (it wrote behind the end of the array 'sensors'"},
        {"no_begin", "cannot begin 3 lives"}};
    for (auto const& [fault, saying] : told) {
        std::string const complaint = complaint_of_stepping(fault);
        EXPECT_THAT(complaint, StartsWith("world trial plain from ")) << fault;
        EXPECT_THAT(complaint, HasSubstr(saying)) << fault;
    }
}

TEST(Library, is_refused_with_facts_that_break_a_rule) {
    std::map<std::string, std::string> const told{{"two_names", "two channels are called 'phase'"},
                                                  {"upper_case", "sensor 1 is called 'Flag'"},
                                                  {"no_name", "sensor 2 has no name"},
                                                  {"no_task", "its task has no name"},
                                                  {"no_unit", "reward unit"},
                                                  {"half_binary", "binary of sensor 1 is 2"},
                                                  {"no_sensors", "sensor_count is 0"},
                                                  {"many_sensors", "sensor_count is 65"},
                                                  {"many_effectors", "effector_count is 17"},
                                                  {"no_effectors", "effectors are NULL"},
                                                  {"many_outcomes", "outcome_size is 257"},
                                                  {"no_batch", "max_batch is 0"},
                                                  {"no_facts", "facts gave NULL"},
                                                  {"no_width", "its width is nan"},
                                                  {"no_height", "its height is 0"}};
    for (auto const& [fault, saying] : told) {
        std::string const complaint = complaint_of([&fault = fault] { trial_world(fault); });
        EXPECT_THAT(complaint, StartsWith("cannot use world " + c_world("trial"))) << fault;
        EXPECT_THAT(complaint, HasSubstr(saying));
    }
}

TEST(Library, that_refuses_its_settings_says_why_in_one_line) {
    std::string const complaint = complaint_of<UsageError>([] { load_world(c_world("trial"), "faults = 3\n"); });
    EXPECT_THAT(complaint, HasSubstr("refuses its settings (it does not know faults = 3"));
    EXPECT_EQ(complaint.find('\n'), std::string::npos);
}

TEST(Library, is_refused_where_it_is_none_or_of_another_version) {
    Scratch const scratch;
    std::ofstream{scratch.file("text.so")} << "no library";
    std::map<std::string, std::string> const told{{scratch.file("text.so"), "Compile it as a shared library"},
                                                  {scratch.file("missing.so"), "cannot open shared object file"},
                                                  {c_world("unnamed"), "it exports no function lore_world"},
                                                  {c_world("later"),
                                                   "it is of version 2 of lore/world.h, and this Lore reads "
                                                   "version 1"},
                                                  {c_world("hollow"), "its function act is NULL"}};
    for (auto const& [file, saying] : told) {
        std::string const complaint = complaint_of([&file = file] { load_world(file, ""); });
        EXPECT_THAT(complaint, StartsWith("cannot use world " + file));
        EXPECT_THAT(complaint, HasSubstr(saying));
    }
}

TEST(LibraryDeathTest, that_crashes_is_named_in_the_last_line) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_DEATH(complaint_of_stepping("crash"),
                 "world trial plain from .*/worlds/trial.so crashed \\(SIGSEGV in its function act\\)");
}

}   // namespace
}   // namespace lore
