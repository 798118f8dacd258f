#include "support/c_worlds.h"
#include "support/program.h"

#include <lore/core/checksum.h>

#include <nlohmann/json.hpp>

#include <map>

using namespace lore;
using lore::test::c_world;
using lore::test::Ran;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

std::string example(std::string const& file) { return std::string{LORE_SOURCE_DIR} + "/docs/examples/" + file; }

/// lore-world in a directory of its own, where the libraries of the tests are found by name.
class LoreWorld : public test::ProgramTest {
protected:
    LoreWorld() : ProgramTest(std::string{LORE_WORLD}) { ::setenv("LORE_WORLD_PATH", LORE_BINARY_DIR "/worlds", 1); }
    ~LoreWorld() override { ::unsetenv("LORE_WORLD_PATH"); }

    /// A configuration of the world of trial_process.py, which runs in the directory of the test.
    std::string process(std::string const& fault, std::string const& patience = "30") {
        std::string const script = std::string{LORE_SOURCE_DIR} + "/tests/support/worlds/trial_process.py";
        write("process.toml", "[world]\nprocess = [\"" LORE_PYTHON "\", \"-IS\", \"" + script +
                                  "\"]\npatience = " + patience + "\n[world.settings]\nfault = \"" + fault + "\"\n");
        return "--config process.toml";
    }

    /// Exit code 1, the rule named in the last line, the others listed.
    void expect_broken(std::string const& fault, std::string const& rule) {
        write("faulty.toml", "[world]\nlibrary = \"trial\"\n[world.settings]\nfault = \"" + fault + "\"\n");
        Ran const ran = run("check --config faulty.toml --steps 700");
        EXPECT_EQ(ran.exit_code, 1) << fault << ran.errors;
        EXPECT_THAT(ran.errors, ::testing::StartsWith("lore-world: world trial plain from ")) << fault;
        EXPECT_THAT(ran.errors, HasSubstr("(" + rule + ": ")) << fault;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
        EXPECT_THAT(ran.output, HasSubstr("BROKEN"));
    }
};

}   // namespace

TEST_F(LoreWorld, finds_that_the_worlds_of_the_documentation_keep_their_contract) {
    for (char const* config : {"pendulum/source.toml", "pendulum/target.toml"}) {
        Ran const ran = run("check --steps 400 --config " + example(config));
        EXPECT_EQ(ran.exit_code, 0) << config << ran.errors;
        EXPECT_THAT(ran.output, Not(HasSubstr("BROKEN"))) << config;
        EXPECT_THAT(ran.output, HasSubstr("million steps a second of one core in batches of 16")) << config;
        EXPECT_THAT(ran.output, Not(HasSubstr("effectors changed nothing"))) << config;
    }
    EXPECT_THAT(run("check collectball:target --steps 100 --lives 4").output, HasSubstr("world collectball target\n"));
    EXPECT_THAT(run("check maze:hard --steps 100 --lives 4").output, HasSubstr("world maze hard\n"));
    std::string const task = "--config " LORE_SOURCE_DIR "/jobs/tasks/maze_hard.toml";
    EXPECT_THAT(run("check --steps 100 --lives 4 " + task).output, HasSubstr("world maze hard\n"));
    EXPECT_EQ(run("-q check trial --steps 50").output, "");
}

TEST_F(LoreWorld, names_the_rule_that_a_world_breaks) {
    expect_broken("nan_sensor", "values");
    expect_broken("sensor_range", "values");
    expect_broken("counter", "repeatable");
    expect_broken("neighbor", "places");
    expect_broken("batch_size", "company");
    expect_broken("scene", "scene");
    expect_broken("scene_text", "scene");
#ifndef LORE_SANITIZED   // which keep what is freed
    expect_broken("leak", "memory");
#endif
}

TEST_F(LoreWorld, ends_with_the_name_of_a_world_that_crashes_or_does_not_return) {
    write("faulty.toml", "[world]\nlibrary = \"trial\"\n[world.settings]\nfault = \"hang\"\n");
    Ran const ran = run("check --config faulty.toml --patience 1");
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.errors, HasSubstr("does not go on (its function act has not returned in the time allowed)"));
    write("faulty.toml", "[world]\nlibrary = \"trial\"\n[world.settings]\nfault = \"crash\"\n");
    EXPECT_THAT(run("check --config faulty.toml").errors, HasSubstr("crashed (SIGSEGV in its function act)"));
}

/// With the interpreter that has numpy before others on PATH.
TEST_F(LoreWorld, checks_and_shows_a_world_in_python) {
    std::string const path = std::getenv("PATH");
    ::setenv("PATH", (std::filesystem::path{LORE_PYTHON}.parent_path().string() + ":" + path).c_str(), 1);
    for (char const* config : {"cartpole/source.toml", "cartpole/target.toml"}) {
        Ran const ran = run("check --steps 400 --config " + example(config));
        EXPECT_EQ(ran.exit_code, 0) << config << ran.errors;
        EXPECT_THAT(ran.output, Not(HasSubstr("BROKEN"))) << config;
        EXPECT_THAT(ran.output, HasSubstr("million steps a second of wall time in batches of 16")) << config;
    }
    auto const told = nlohmann::json::parse(run("info --json --config " + example("cartpole/target.toml")).output);
    EXPECT_EQ(told.at("task"), "short_pole");
    EXPECT_EQ(told.at("process").at("command"), (std::vector<std::string>{"python3", "cartpole.py"}));
    EXPECT_EQ(told.at("process").at("checksum"), checksum_text(checksum_of_file(example("cartpole/cartpole.py"))));
    EXPECT_THAT(run("info --config " + example("cartpole/source.toml")).output,
                HasSubstr("process      python3 cartpole.py, "));
    ::setenv("PATH", path.c_str(), 1);
}

TEST_F(LoreWorld, ends_with_the_name_of_a_process_that_goes_wrong) {
    std::string const called = "lore-world: world trial plain from " LORE_PYTHON " -IS ";
    for (auto const& [fault, saying] :
         std::map<std::string, std::string>{{"exits", " ended at step 16 (exit code 3)"},
                                            {"hangs", " does not answer at step 16 (no answer came within 4 s)"},
                                            {"prints", " sent nonsense at step 16 ('now at step 17' where"},
                                            {"nan_sensor", "(sensor 'phase' of life 15 is NaN"}}) {
        Ran const ran = run("-q check " + process(fault, fault == "hangs" ? "4" : "30"));
        EXPECT_EQ(ran.exit_code, 1) << fault;
        EXPECT_THAT(ran.errors, ::testing::StartsWith(called)) << fault;
        EXPECT_THAT(ran.errors, HasSubstr(saying)) << fault;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
    }
    EXPECT_THAT(run("check --patience 5 " + process("hangs")).errors, HasSubstr("no answer came within 5 s"));
    Ran const run_of_library = run("info trial " + process("exits"));
    EXPECT_THAT(run_of_library.output, HasSubstr("library      ")) << "WORLD comes before what the configuration names";
    write("refused.toml", "[world]\nprocess = [\"no-such-program\"]\n");
    expect_refusal("info --config refused.toml", 2, "cannot start no-such-program (No such file or directory)");
    write("both.toml", "[world]\nprocess = [\"sh\"]\nlibrary = \"trial\"\n");
    expect_refusal("info --config both.toml", 2, "both.toml: world.process (the world is a library already)");
}

TEST_F(LoreWorld, shows_the_facts_as_text_and_json) {
    std::string const config = "--config " + example("pendulum/target.toml");
    std::string const text = run("info " + config).output;
    for (char const* line : {"world        pendulum\n", "task         long_pole\n", "reward       height\n",
                             "sensors      3: rightward, upward, turning\n", "effectors    1: torque\n",
                             "settings     length = 1.5\n             task = \"long_pole\"\n"})
        EXPECT_THAT(text, HasSubstr(line));
    auto const told = nlohmann::json::parse(run("info --json " + config).output);
    EXPECT_EQ(told.at("task"), "long_pole");
    EXPECT_EQ(told.at("sensors").at(2).at("name"), "turning");
    EXPECT_EQ(told.at("library").at("checksum"), checksum_text(checksum_of_file(c_world("pendulum"))));
    EXPECT_THAT(run("info trial").output, HasSubstr("3: phase, flag (binary), echo\n"));
    std::string const of_collectball = run("info collectball").output;
    EXPECT_THAT(of_collectball, HasSubstr("library      none: it is built in\n"));
    EXPECT_THAT(of_collectball, HasSubstr("size         600 x 400.34 u\n"));
}

TEST_F(LoreWorld, refuses_what_is_no_world) {
    write("text.so", "no library");
    write("empty.toml", "[evolution]\n");
    write("wrong.toml", "[world]\nlibrary = \"maze\"\n[world.settings]\nmaze = \"soft\"\n");
    expect_refusal("info", 2, "no world is named");
    expect_refusal("info --config empty.toml", 2, "it has no world.library and no world.process");
    expect_refusal("info missing", 2, "there is no missing.so or libmissing.so in ., ");
    expect_refusal("info ./missing.so", 2, "No such file");
    expect_refusal("info colectball:source", 2, "Did you mean 'collectball'?");
    expect_refusal("info --config wrong.toml", 2, "there is no maze 'soft' (those are: medium, hard)");
    expect_refusal("check empty.toml", 2, "Say --config empty.toml");
    expect_refusal("check ./text.so", 1, "Compile it as a shared library");
    expect_refusal("check later", 1, "it is of version 2");
    expect_refusal("check unnamed", 1, "it exports no function lore_world");
    expect_refusal("check trial --steps 0", 2, "--steps");
    expect_refusal("chekc trial", 2, "'chekc' was not expected");
}
