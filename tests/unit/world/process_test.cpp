#include <lore/world/process.h>

#include <lore/world/contract.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>
#include <vector>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lore {
namespace {

using test::complaint_of;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Without its site's modules it starts soon.
std::vector<std::string> const trial_command{LORE_PYTHON, "-IS", "trial_process.py"};
std::string const command_text = std::string{LORE_PYTHON} + " -IS trial_process.py";
std::string const worlds = std::string{LORE_SOURCE_DIR} + "/tests/support/worlds";

/// The world of trial_process.py with a fault, or with "" none.
std::unique_ptr<World> trial(std::string const& fault = "", std::string const& settings = "", double patience = 30) {
    return start_world({trial_command, worlds, patience},
                       (fault.empty() ? "" : "fault = \"" + fault + "\"\n") + settings);
}

std::unique_ptr<World> shell(std::string const& script, double patience = 30) {
    return start_world({{"sh", "-c", script}, "", patience}, "");
}

/// Steps a batch of three until the process is told off, or 30 steps have gone by.
std::string complaint_of_a_process(std::string const& fault, double patience = 30) {
    return complaint_of([&] {
        auto const world = trial(fault, "", patience);
        auto const lives = world->begin_lives(3);
        std::array<float, 6> sensors{};
        std::array<float, 3> x{}, y{}, rewards{}, outcomes{};
        std::array<unsigned char, 3> over{};
        for (int step = 0; step < 30; ++step) {
            lives->sense(sensors, x, y);
            lives->act(std::array{0.5f, 0.75f, 1.0f}, rewards, over);
        }
        lives->outcome(outcomes);
    });
}

double seconds_of(auto const& call) {
    auto const start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The number that the process of a world wrote into `file`.
pid_t number_in(std::string const& file) {
    pid_t number = 0;
    for (int i = 0; i < 3000 && number == 0; ++i) {
        std::ifstream{file} >> number;
        if (number == 0) std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return number;
}

bool is_there(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

TEST(Process, tells_its_facts) {
    auto const world = trial();
    WorldFacts const& facts = world->facts();
    EXPECT_EQ(facts.name, "trial");
    EXPECT_EQ(facts.task, "plain");
    EXPECT_EQ(facts.reward_unit, "pushes");
    EXPECT_EQ(facts.sensors, (std::vector<ChannelInfo>{{"phase", false}, {"flag", true}}));
    EXPECT_EQ(facts.effectors, (std::vector<ChannelInfo>{{"push", false}}));
    EXPECT_EQ(facts.outcome_size, 1);
    EXPECT_EQ(facts.max_batch, 64);
    EXPECT_EQ(facts.width, 2);
    EXPECT_EQ(facts.height, 3);
    EXPECT_EQ(world->scene_svg(), "<g/>");
}

TEST(Process, gives_a_life_what_it_gives_a_batch) {
    auto const world = trial();
    auto const life = world->begin();
    auto const lives = world->begin_lives(2);
    std::array<float, 2> sensors{};
    std::array<float, 4> both{};
    std::array<float, 2> x{}, y{}, rewards{}, outcomes{};
    std::array<unsigned char, 2> over{};
    int steps = 0;
    for (; over[1] == 0; ++steps) {
        ASSERT_LT(steps, 1000);
        float const push = static_cast<float>(steps % 32) / 32 + 0.5f;
        Position const at = life->sense(sensors);
        lives->sense(both, x, y);
        ASSERT_EQ(sensors, (std::array{both[1], both[3]}));
        ASSERT_EQ(at, (Position{x[1], y[1]}));
        lives->act(std::array{0.25f, push > 1 ? 1 : push}, rewards, over);
        StepResult const result = life->act(std::array{push > 1 ? 1 : push});
        ASSERT_EQ(result, (StepResult{rewards[1], over[1] != 0}));
    }
    lives->act(std::array{0.25f, 1.0f}, rewards, over);
    EXPECT_EQ(over, (std::array<unsigned char, 2>{0, 1}));
    EXPECT_EQ(rewards, (std::array{0.25f, 0.0f})) << "it was over before";
    std::array<float, 1> outcome{};
    life->outcome(outcome);
    lives->outcome(outcomes);
    EXPECT_EQ(outcome[0], 700);
    EXPECT_EQ(outcomes, (std::array{0.0f, 700.0f}));
}

TEST(Process, keeps_the_contract_of_worlds) {
    auto const world = trial();
    ContractReport const report = check_contract(*world, [] { return trial(); }, {4, 100, 1});
    for (RuleReport const& rule : report.rules) EXPECT_TRUE(rule.kept) << rule.rule << ": " << rule.finding;
    EXPECT_GT(measure_speed(*world, 4, 0.02, Timekeeper::wall), 100);
}

TEST(Process, is_told_off_for_a_wrong_value_with_its_place_and_number) {
    EXPECT_EQ(complaint_of_a_process(""), "");
    std::map<std::string, std::string> const told{
        {"nan_sensor", "step 17 (sensor 'phase' of life 2 is NaN"},
        {"sensor_range", "step 17 (sensor 'phase' of life 2 is 1.25, and sensors lie in [0, 1]"},
        {"binary", "step 17 (binary sensor 'flag' of life 2 is 0.25"},
        {"position", "step 17 (x of life 2 is -3, and positions lie in 0 .. width = 2"},
        {"infinite_reward", "step 16 (the reward of life 0 is inf"},
        {"over", "step 16 (over of life 0 is 2"},
        {"outcome", "step 30 (outcome 0 of life 0 is NaN"}};
    for (auto const& [fault, saying] : told) {
        std::string const complaint = complaint_of_a_process(fault);
        EXPECT_THAT(complaint, StartsWith("world trial plain from " + command_text + " breaks its contract at "));
        EXPECT_THAT(complaint, HasSubstr(saying)) << fault;
    }
}

TEST(Process, that_ends_or_fails_or_sends_something_else_is_told_off_in_one_line) {
    std::map<std::string, std::string> const told{
        {"exits", "ended at step 16 (exit code 3)"},
        {"is_killed", "ended at step 16 (signal 9, Killed)"},
        {"cut", "ended at step 16 (exit code 0)"},
        {"closes", "ended at step 16 (it has closed its standard output)"},
        {"fails", "failed at step 16 (the pole broke)"},
        {"prints", "sent nonsense at step 16 ('now at step 17' where its answer 'results' was expected)"},
        {"zeros", "sent nonsense at step 16 (bytes 00 00 00 00 00 00 00 00 where"},
        {"stammers", "sent nonsense at step 16 (bytes 72 65 73 74 00 00 00 where"},
        {"prints_behind", "sent nonsense at step 16 ('done' behind its answer 'results')"},
        {"short", "sent nonsense at step 16 (its answer 'results' for 3 lives has 62 bytes, and not 63)"},
        {"long", "sent nonsense at step 16 (its answer 'results' has 64 bytes, and 63 at most)"},
        {"endless", "(its answer 'results' has 4294967295 bytes, and 63 at most)"},
        {"other_answer", "sent nonsense at step 16 (bytes 73 65 6e 73 65 73 00 00 where its answer 'results'"},
        {"other_batch", "sent nonsense at step 16 (it answered for batch 2, and batch 1 was asked)"},
        {"refuses_late", "sent nonsense at step 16 (bytes 72 65 66 75 73 65 64 00 where"}};
    for (auto const& [fault, saying] : told) {
        std::string const complaint = complaint_of_a_process(fault);
        EXPECT_THAT(complaint, StartsWith("world trial plain from " + command_text + " ")) << fault;
        EXPECT_THAT(complaint, HasSubstr(saying)) << fault;
        EXPECT_EQ(complaint.find('\n'), std::string::npos);
    }
}

TEST(Process, has_patience_but_not_without_end) {
    EXPECT_EQ(complaint_of_a_process("slow"), "") << "79 bytes, one after the other";
    std::string complaint;
    EXPECT_LT(seconds_of([&] { complaint = complaint_of_a_process("hangs", 4); }), 30);
    EXPECT_THAT(complaint, HasSubstr("does not answer at step 16 (no answer came within 4 s)"));
    EXPECT_THAT(complaint, HasSubstr("allow more 'patience'"));
}

TEST(Process, that_was_told_off_is_so_at_each_later_call) {
    auto const world = trial("exits");
    auto const life = world->begin();
    auto const other = world->begin();
    auto const push = [&] {
        for (int step = 0; step < 17; ++step) life->act(std::array{0.5f});
    };
    std::string const first = complaint_of(push);
    EXPECT_THAT(first, HasSubstr("ended at step 16"));
    EXPECT_EQ(complaint_of([&] { other->act(std::array{0.5f}); }), first);
    EXPECT_EQ(complaint_of([&] { world->begin(); }), first);
}

TEST(Process, that_cannot_be_started_is_a_configuration_error) {
    Scratch const scratch;
    EXPECT_THAT(
        complaint_of<UsageError>([] {
            start_world({{"no-such-program"}, ""}, "");
        }),
        HasSubstr("cannot start no-such-program (No such file or directory). Install it, or correct 'process'"));
    EXPECT_THAT(complaint_of<UsageError>([&] {
                    start_world({{"sh"}, scratch.file("none")}, "");
                }),
                HasSubstr("cannot start sh in " + scratch.file("none") + " (there is no such folder). Put it back"));
    std::ofstream{scratch.file("plain.txt")} << "no program\n";
    EXPECT_THAT(complaint_of<UsageError>([&] {
                    start_world({{"./plain.txt"}, scratch.path()}, "");
                }),
                HasSubstr("cannot start ./plain.txt in "));
}

TEST(Process, that_refuses_its_settings_says_why_in_one_line) {
    std::string const complaint = complaint_of<UsageError>([] { trial("", "length = 3\n"); });
    EXPECT_THAT(complaint, StartsWith("world " + command_text + " refuses its settings (it does not know {'length"));
    EXPECT_EQ(complaint.find('\n'), std::string::npos);
}

TEST(Process, is_refused_with_facts_that_break_a_rule) {
    std::map<std::string, std::string> const told{
        {"name", "the world is called 'Trial'"},
        {"binary_fact", "binary of sensor 1 is 2"},
        {"many_effectors", "its number of effectors is 17, which is outside 1 .. 16"},
        {"max_batch", "its max_batch is 0"},
        {"huge_batch", "its max_batch is 2147483647"},
        {"version", "it speaks version 2 of the frames, and this Lore version 1"},
        {"long_scene", "its scene has more than 1000000 bytes"},
        {"long_facts", "is too short or too long"},
        {"short_facts", "is too short or too long"},
        {"lying_text", "is too short or too long"}};
    for (auto const& [fault, saying] : told) {
        std::string const complaint = complaint_of([&fault = fault] { trial(fault); });
        EXPECT_THAT(complaint, StartsWith("cannot use world " + command_text + " (")) << fault;
        EXPECT_THAT(complaint, HasSubstr(saying)) << fault;
    }
}

TEST(Process, is_no_world_where_it_does_not_know_the_frames) {
    std::map<std::string, std::string> const told{
        {"true", "ended at its start (exit code 0)"},
        {"exit 3", "ended at its start (exit code 3)"},
        {"cat", "sent nonsense at its start (bytes 6f 70 65 6e 00 00 00 00 where its answer 'facts' was expected)"},
        {"echo Welcome to my world; sleep 600", "('Welcome to my world' where its answer 'facts' was expected)"},
        {"sleep 600 & exit 4", "ended at its start (exit code 4)"}};   // the one at rest holds the pipes open
    for (auto const& [script, saying] : told)
        EXPECT_THAT(complaint_of([&script = script] { shell(script); }), HasSubstr(saying)) << script;
    EXPECT_THAT(complaint_of([] { shell("sleep 600", 0.2); }),
                HasSubstr("does not answer at its start (no answer came within"));
}

TEST(Process, ends_with_its_world_and_leaves_no_zombie) {
    Scratch const scratch;
    std::string const settings = "process_file = \"" + scratch.file("number") + "\"\n";
    for (char const* fault : {"", "hangs_at_the_end"}) {
        std::remove(scratch.file("number").c_str());
        auto world = trial(fault, settings);
        pid_t const process = number_in(scratch.file("number"));
        EXPECT_TRUE(is_there(process));
        EXPECT_LT(seconds_of([&] { world.reset(); }), 20);
        EXPECT_FALSE(is_there(process)) << fault;
    }
    std::remove(scratch.file("number").c_str());
    // A process of the process, in its group.
    EXPECT_NE(complaint_of([&] { shell("sleep 600 & echo $! > " + scratch.file("number") + "; exit 1"); }), "");
    pid_t const process = number_in(scratch.file("number"));
    for (int i = 0; i < 1000 && is_there(process); ++i) std::this_thread::sleep_for(std::chrono::milliseconds{10});
    std::ifstream state{"/proc/" + std::to_string(process) + "/stat"};
    std::string number, name, letter;
    state >> number >> name >> letter;
    EXPECT_TRUE(letter.empty() || letter == "Z") << "it is killed; who adopts orphans may not wait for it: " << letter;
}

TEST(Process, is_killed_where_its_parent_is) {
    Scratch const scratch;
    std::string const settings = "process_file = \"" + scratch.file("number") + "\"\n";
    ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);   // orphans come to us
    pid_t const parent = ::fork();
    if (parent == 0) {
        auto const world = trial("hangs_at_the_end", settings);
        for (;;) ::pause();
    }
    pid_t const process = number_in(scratch.file("number"));
    EXPECT_TRUE(is_there(process));
    ::kill(parent, SIGKILL);
    int status = 0;
    EXPECT_EQ(::waitpid(parent, &status, 0), parent);
    EXPECT_EQ(::waitpid(process, &status, 0), process);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST(Process, may_have_many_batches_under_way_and_be_twice) {
    auto const world = trial(), second = trial();
    auto const three = world->begin_lives(3), elsewhere = second->begin_lives(2);
    auto two = world->begin_lives(2);
    std::array<float, 3> rewards{};
    std::array<unsigned char, 3> over{};
    std::array<float, 3> outcomes{};
    for (int step = 0; step < 5; ++step) {
        three->act(std::array{1.0f, 0.0f, 1.0f}, rewards, over);
        if (step < 2) two->act(std::array{0.0f, 1.0f}, std::span{rewards}.first(2), std::span{over}.first(2));
        elsewhere->act(std::array{1.0f, 1.0f}, std::span{rewards}.first(2), std::span{over}.first(2));
    }
    two->outcome(std::span{outcomes}.first(2));
    EXPECT_EQ(outcomes[1], 2);
    two.reset();
    three->outcome(outcomes);
    EXPECT_EQ(outcomes, (std::array{5.0f, 0.0f, 5.0f}));
}

TEST(Process, takes_batches_of_more_bytes_than_a_pipe_holds) {
    auto const world = start_world({trial_command, worlds}, "fault = \"wide\"\n");
    int const lives = world->facts().max_batch;
    ASSERT_EQ(lives, most_lives);
    auto const n = static_cast<std::size_t>(lives);
    auto const batch = world->begin_lives(lives);
    std::vector<float> const effectors(16 * n, 0.5f);
    std::vector<float> rewards(n);
    std::vector<unsigned char> over(n);
    batch->act(effectors, rewards, over);
    EXPECT_EQ(rewards, std::vector<float>(n, 0.5f));
}

}   // namespace
}   // namespace lore
