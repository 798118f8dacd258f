// Worlds of one's own and the built-in maze, from a configuration to knowledge that serves another task: on any number
// of ranks, with any instruction set, after kills; and what a run refuses.

#include "system/evolve_command.h"

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

/// A directory with a library of docs/examples or tests/support/worlds and configurations that name it.
class Worlds : public SystemTest {
protected:
    std::string configuration(std::string const& name, std::string const& library, std::string const& settings,
                              int generations = 12) {
        std::string const path = scratch.file(name + ".toml");
        write_file_atomically(path, std::string_view{"name = \"" + name + "\"\n[world]\nlibrary = \"" + library +
                                                     "\"\nsettings = {" + settings +
                                                     "}\n[episode]\nsteps = 200\n[evolution]\npopulation = 12\n"
                                                     "founders = 24\ngenerations = " +
                                                     std::to_string(generations) +
                                                     "\n[diversity]\nperiod = 3\n[checkpoint]\ngenerations = 4\n"});
        return path;
    }
    /// A copy, as its author would put it beside the configuration.
    void bring(std::string const& library, std::string const& as = "") {
        std::filesystem::copy_file(std::string{LORE_BINARY_DIR} + "/worlds/" + library + ".so",
                                   scratch.file((as.empty() ? library : as) + ".so"),
                                   std::filesystem::copy_options::overwrite_existing);
    }
};

}   // namespace

TEST_F(Worlds, give_one_run_on_any_number_of_ranks_with_any_instruction_set_and_after_kills) {
    for (auto const& [library, settings] : {std::pair{"pendulum", "task = \"short_pole\""},
                                            {"maze", "maze = \"medium\", reward = \"way\""},
                                            {"trial", ""}}) {
        if (std::string_view{library} != "maze") bring(library);
        std::string const config = configuration(library, library, settings), run = scratch.file(library);
        std::string const expected = signature_of_run(evolve(config, run + "1"));
        for (int const ranks : {2, 3, 5}) {
            std::string const other = run + std::to_string(ranks);
            EXPECT_EQ(signature_of_run(on_ranks(ranks) + evolve(config, other)), expected) << library << ranks;
            EXPECT_EQ(results(other), results(run + "1")) << library << ranks;
        }
        EXPECT_EQ(signature_of_run(std::vector<std::string>{"LORE_ISA=baseline"} + evolve(config, run + "b")),
                  expected);

        for (int kills = 0; kills < 3; ++kills) {
            Command killed{scratch, evolve(config, run + "k", {"--resume", "--max-time", "0"})};
            EXPECT_EQ(killed.wait(), 75) << killed.err();
        }
        EXPECT_EQ(signature_of_run(evolve(config, run + "k", {"--resume"})), expected);
        EXPECT_EQ(results(run + "k"), results(run + "1")) << library;
    }
}

TEST_F(Worlds, give_knowledge_of_a_source_task_that_serves_a_target_task) {
    bring("pendulum");
    std::string const source = configuration("source", "pendulum", "task = \"short_pole\", length = 1.0"),
                      target = configuration("target", "pendulum", "task = \"long_pole\", length = 1.5"),
                      run = scratch.file("run"), base = scratch.file("base.lorekb"), best = scratch.file("best.lorekb");
    expect_done(evolve(source, run));
    expect_done({program("lore-kb"), "build", run, "--out", base, "-q"});
    expect_done({program("lore-kb"), "reduce", base, "--top", "20", "--out", best, "-q"});
    for (std::string const& made : {run, base, best}) expect_done({program("lore-kb"), "verify", made});
    std::string const shaped = signature_of_run(evolve(target, scratch.file("shaped"), {"--kb", base}));
    EXPECT_EQ(signature_of_run(on_ranks(3) + evolve(target, scratch.file("shaped3"), {"--kb", base})), shaped);
    std::string const cloned = signature_of_run(evolve(target, scratch.file("cloned"), {"--founders", best}));
    EXPECT_EQ(signature_of_run(on_ranks(2) + evolve(target, scratch.file("cloned2"), {"--founders", best})), cloned);
    std::string const policy = signature_of_run(evolve(target, scratch.file("policy"), {"--founders", run}));
    EXPECT_NE(shaped, cloned);
    EXPECT_NE(cloned, policy);

    Command told{scratch, {program("lore-kb"), "info", base}};
    EXPECT_EQ(told.wait(), 0);
    EXPECT_THAT(told.out(), HasSubstr("pendulum short_pole"));
    EXPECT_THAT(told.out(), HasSubstr("4 channels"));
}

TEST_F(Worlds, of_other_channels_refuse_knowledge_and_founders_in_one_line_and_write_nothing) {
    bring("pendulum");
    std::string const pole = configuration("pole", "pendulum", ""), maze = configuration("maze", "maze", "");
    std::string const run = scratch.file("run"), base = scratch.file("base.lorekb"), never = scratch.file("never");
    expect_done(evolve(pole, run));
    expect_done({program("lore-kb"), "build", run, "--out", base, "-q"});
    expect_refusal(evolve(maze, never, {"--kb", base}), 2, "does not fit the run");
    expect_refusal(evolve(maze, never, {"--founders", base}), 2, "does not fit the run");
    expect_refusal(on_ranks(2) + evolve(maze, never, {"--founders", run}), 2, "does not fit the run");
    expect_refusal(evolve(small_config(scratch), never, {"--kb", base}), 2, "does not fit the run");
    EXPECT_FALSE(exists(never));
}

TEST_F(Worlds, are_found_beside_a_configuration_that_is_named_without_a_directory) {
    bring("pendulum");
    std::string const config = configuration("here", "pendulum", ""), run = scratch.file("run");
    std::vector<std::string> words = evolve("here.toml", run);
    words.insert(words.begin(), {"env", "-C", scratch.path()});
    EXPECT_EQ(signature_of_run(words), signature_of_run(evolve(config, scratch.file("by_path"))));
    expect_done({program("lore-kb"), "build", run, "--out", scratch.file("base.lorekb"), "-q"});
    expect_done({program("lore-world"), "info", "--config", run + "/config.toml"});
}

TEST_F(Worlds, in_a_process_give_one_run_on_any_number_of_ranks_and_after_a_stop) {
    std::string const config = LORE_SOURCE_DIR "/docs/examples/cartpole/source.toml", run = scratch.file("run");
    // The Python that has numpy comes first.
    std::vector<std::string> const there{"PATH=" + std::filesystem::path{LORE_PYTHON}.parent_path().string() + ":" +
                                         std::getenv("PATH")};
    std::vector<std::string> const small{"--set", "episode.steps=60",        "--set", "evolution.generations=6",
                                         "--set", "evolution.population=10", "--set", "evolution.founders=20"};
    auto const resumed = small + std::vector<std::string>{"--resume"};
    std::string const expected = signature_of_run(there + evolve(config, run + "1", small));
    EXPECT_EQ(signature_of_run(there + on_ranks(3) + evolve(config, run + "3", small)), expected);
    EXPECT_EQ(results(run + "3"), results(run + "1"));
    Command stopped{scratch, there + evolve(config, run, small + std::vector<std::string>{"--max-time", "0"})};
    EXPECT_EQ(stopped.wait(), 75) << stopped.err();
    EXPECT_EQ(signature_of_run(there + evolve(config, run, resumed)), expected);
    expect_done(there +
                std::vector<std::string>{program("lore-kb"), "build", run, "--out", scratch.file("base.lorekb"), "-q"});
    EXPECT_THAT(file_text(run + "/manifest.json"), HasSubstr("\"name\": \"cartpole\""));
}

TEST_F(Worlds, that_were_built_anew_are_not_those_of_a_run_that_was_begun) {
    bring("trial", "mine");
    std::string const config = configuration("mine", "mine", ""), run = scratch.file("run");
    Command start{scratch, evolve(config, run, {"--max-time", "0"})};
    EXPECT_EQ(start.wait(), 75) << start.err();
    std::string const before = file_text(run + "/checkpoint.lore");
    bring("pendulum", "mine");
    expect_refusal(evolve(config, run, {"--resume"}), 2, "cannot go on with " + run);
    expect_refusal({program("lore-kb"), "build", run, "--out", scratch.file("never")}, 1,
                   "cannot open the run in " + run);
    EXPECT_EQ(file_text(run + "/checkpoint.lore"), before) << "nothing is lost";
    bring("trial", "mine");
    Command again{scratch, evolve(config, run, {"--resume"})};
    EXPECT_EQ(again.wait(), 0) << again.err();
    expect_refusal(evolve(configuration("other", "mine", "fault = \"nan_sensor\""), run, {"--resume"}), 2,
                   "under another configuration");
}

TEST_F(Worlds, that_cannot_be_had_are_refused_before_anything_is_written) {
    bring("trial");
    bring("later");
    bring("unnamed");
    std::string const never = scratch.file("never");
    expect_refusal(evolve(configuration("a", "nowhere", ""), never), 2, "cannot find world nowhere");
    expect_refusal(evolve(configuration("b", "later", ""), never), 1, "it is of version 2 of lore/world.h");
    expect_refusal(evolve(configuration("c", "unnamed", ""), never), 1, "it exports no function lore_world");
    expect_refusal(evolve(configuration("d", "trial", "color = 1"), never), 2, "refuses its settings");
    expect_refusal(on_ranks(2) + evolve(configuration("e", "trial", "fault = \"many_sensors\""), never), 1,
                   "its sensor_count is 65");
    expect_refusal(evolve(configuration("f", "trial", ""), never, {"--set", "limits.max_edges=5"}), 2,
                   "limits.max_edges is too small");
    expect_refusal(evolve(configuration("m", "maze", "maze = \"soft\""), never), 2, "there is no maze 'soft'");
    expect_refusal(evolve(configuration("n", "maze", "walls = 3"), never), 2, "walls (unknown key)");
    expect_refusal(evolve(configuration("g", "trial", ""), never, {"--set", "task=target"}), 2, "task is set");
    EXPECT_FALSE(exists(never));
}

TEST_F(Worlds, that_break_their_contract_or_crash_end_the_run_with_a_line_that_names_them) {
    bring("trial");
    for (char const* const fault : {"nan_sensor", "infinite_reward", "crash"}) {
        std::string const config = configuration(fault, "trial", std::string{"fault = \""} + fault + "\"");
        Command command{scratch, evolve(config, scratch.file(fault))};
        EXPECT_NE(command.wait(), 0) << fault;
        EXPECT_THAT(command.err(), HasSubstr("trial")) << fault;
    }
}
