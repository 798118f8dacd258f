#include "campaign_fixture.h"

#include <lore/archive/knowledge_file.h>
#include <lore/collectball/arena.h>
#include <lore/campaign/choice.h>
#include <lore/campaign/replay_step.h>
#include <lore/experiment/knowledge_building.h>
#include <support/c_worlds.h>
#include <support/small_run.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace lore;

namespace {

constexpr char shown_campaign[] = R"(
title = "One run each"
runs = 1
[source]
config = "small.toml"
[[knowledge]]
name = "kb1"
balls = 1
[[treatment]]
name = "none"
config = "small.toml"
[report]
trajectory = "kb1"
figure5 = ["kb1"]
figure6 = ["kb1", "kb1"]
)";

}   // namespace

/// A campaign of two runs of 400 steps that are really there, and the knowledge base of the first.
class ReplayStepTest : public test::CampaignTest {
protected:
    ReplayStepTest() {
        write("campaign.toml", shown_campaign);
        write("small.toml",
              "name = \"experiment\"\ntask = \"source\"\n[episode]\nsteps = 400\n[evolution]\npopulation = 8\n"
              "founders = 16\ngenerations = 6\n[diversity]\nperiod = 2\n");
    }
    void make_run(std::string const& step, std::string const& signature, WorldRequest const& world = {}) const {
        std::string const run = directory().run(step), manifest_path = run + "/" + run_file::manifest;
        if (!std::filesystem::exists(run)) test::write_small_run(run, 1, world);
        Manifest manifest = read_manifest(manifest_path);
        manifest.seed = 1;
        manifest.signature = signature;
        write_manifest(manifest_path, manifest);
    }
    void make_knowledge() const {
        RunDirectory const run = open_run(directory().run("source/001"));
        std::filesystem::create_directories(scratch.file("c/knowledge"));
        write_knowledge_base(directory().knowledge("kb1"),
                             knowledge_of_lineage(run, *run.individual("best"), run.config.knowledge, IndexKind::exact,
                                                  {}, [](std::int64_t, std::int64_t) {}));
        write_choice(directory().choice(), {{{"kb1", 1, 1, 1, 0}}, {{1, 1, 0}}, {}});
    }
};

TEST_F(ReplayStepTest, simulates_the_source_run_and_the_best_target_run_and_values_the_first) {
    make_run("source/001", "00000000000000aa");
    make_run("none/001", "00000000000000bb");
    make_knowledge();
    make_replays(plan(), directory(), directory());

    Replays const shown = read_replays(directory());
    ASSERT_EQ(shown.replays.size(), 2u);
    EXPECT_EQ(shown.replays[0].run, "source/001");
    EXPECT_EQ(shown.replays[1].run, "none/001");
    EXPECT_EQ(shown.replays[1].signature, "00000000000000bb");
    EXPECT_EQ(shown.replays[1].steps.size(), 400u);
    EXPECT_EQ(shown.replays[0].arena->scene, scene_of(load_arena("collectball", "source"))) << "to the bit";
    ASSERT_EQ(shown.panels.size(), 2u);
    ASSERT_EQ(shown.panels[0].values.size(), 20u) << "windows of 20 steps";
    EXPECT_EQ(shown.panels[1].knowledge, "kb1*kb1");
    for (std::size_t w = 0; w < 20; ++w) {
        double const value = shown.panels[0].values[w];
        EXPECT_EQ(std::isnan(shown.panels[1].values[w]), std::isnan(value));
        if (!std::isnan(value)) { EXPECT_NEAR(shown.panels[1].values[w], value * value, 1e-3); }
    }
    EXPECT_EQ(shown.panels[0].window_length, 20);
    EXPECT_EQ(shown.panels[1].window_length, 20);
}

TEST_F(ReplayStepTest, is_done_until_there_is_something_else_to_show) {
    EXPECT_EQ(state("replay").status, StepStatus::missing);
    EXPECT_FALSE(replay_is_due(plan(), directory(), directory())) << "nothing to show yet";
    EXPECT_THROW(make_replays(plan(), directory(), directory()), Error);
    make_run("source/001", "00000000000000aa");
    make_knowledge();
    EXPECT_EQ(replay_is_due(plan(), directory(), directory()), "not made yet");
    make_replays(plan(), directory(), directory());
    EXPECT_EQ(state("replay").status, StepStatus::done);
    EXPECT_TRUE(replay_is_due(plan(), directory(), directory("elsewhere"))) << "for a report elsewhere";

    make_run("none/001", "00000000000000bb");
    EXPECT_EQ(state("replay").status, StepStatus::missing);
    make_replays(plan(), directory(), directory());
    EXPECT_EQ(state("replay").status, StepStatus::done);
    make_run("none/001", "00000000000000cc");
    EXPECT_EQ(replay_is_due(plan(), directory(), directory()), "it should show none/001") << "it was made again";
    make_replays(plan(), directory(), directory("made/elsewhere"));
    EXPECT_FALSE(replay_is_due(plan(), directory(), directory("made/elsewhere")));
    write("c/knowledge/kb1.lorekb", "another");
    EXPECT_EQ(replay_is_due(plan(), directory(), directory("made/elsewhere")),
              "there are other knowledge bases by now");
}

TEST_F(ReplayStepTest, comes_after_all_that_it_shows_and_does_without_what_failed) {
    auto const steps = steps_of(plan());
    EXPECT_EQ(steps.back().name, "replay");
    EXPECT_EQ(steps.back().after, (std::vector<std::string>{"choose", "knowledge/kb1", "none"}));
    EXPECT_TRUE(steps.back().takes_what_is_there);
    EXPECT_EQ(shell_text(command_of(plan(), directory(), {}, steps.back(), nullptr)),
              "lore-campaign replay " + scratch.file("campaign.toml") + " --dir " + scratch.file("c"));
}

TEST_F(ReplayStepTest, files_that_do_not_belong_together_are_refused) {
    make_run("source/001", "00000000000000aa");
    make_knowledge();
    make_replays(plan(), directory(), directory());
    std::string const text = read(directory().file("replay.csv"));
    write("c/replay.csv", text.substr(0, text.find('\n') + 1) + "kb9/001,0,1,1,0,0,0,0,0,0\n");
    EXPECT_THROW(read_replays(directory()), Error);
    write("c/replay.csv", text.substr(0, text.find('\n') + 1));
    EXPECT_THROW(read_replays(directory()), Error) << "no step at all";
    write("c/scene.json", "{\"replays\": [{}]}");
    EXPECT_THROW(read_scenes(directory()), Error);
    EXPECT_EQ(replay_is_due(plan(), directory(), directory()), "scene.json is damaged");
}

/// A life of so many steps in an arena of nothing, and a panel of that many windows.
class ReplayFiles : public test::CampaignTest {
protected:
    static Replays life_of(int steps, std::vector<double> values, int window_length) {
        Replay replay{"source/001", "00000000000000aa", "balls", {}, {}, ArenaReplay{}};
        replay.arena->scene.width = replay.arena->scene.height = 1;
        replay.arena->scene.basket_lights = {{0, 0}};
        replay.steps.resize(static_cast<std::size_t>(steps));
        replay.arena->steps.resize(static_cast<std::size_t>(steps));
        return {{replay}, {{"figure5", "kb1", std::move(values), "c", window_length}}};
    }
    /// What is read of these files.
    PanelValues panel_of(Replays const& all) const {
        write_replays(directory(), all);
        return read_replays(directory()).panels.front();
    }
    /// As they were written before 1.0.0.
    PanelValues former_panel(int steps, std::string const& knowledge, std::vector<std::string> const& values) const {
        write_replays(directory(), life_of(steps, {}, 0));
        std::string table = "figure,knowledge,window,value\n", scene = read(directory().file("scene.json"));
        for (std::size_t w = 0; w < values.size(); ++w)
            table += "figure5," + knowledge + "," + std::to_string(w) + "," + values[w] + "\n";
        write("c/values.csv", table);
        write("c/scene.json", scene.replace(scene.find("kb1"), 3, knowledge));
        return read_replays(directory()).panels.front();
    }
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

TEST_F(ReplayFiles, keep_the_length_of_windows_that_does_not_divide_a_life) {
    EXPECT_EQ(panel_of(life_of(41, {1, 2}, 15)).window_length, 15) << "30 steps, and 11 of no whole window";
    EXPECT_THROW(panel_of(life_of(41, {1, 2, 3}, 15)), Error);
}

TEST_F(ReplayFiles, have_an_empty_field_for_a_window_that_is_not_found_and_negative_values_in_arenas) {
    PanelValues const panel = panel_of(life_of(60, {-1, none, 0}, 20));
    EXPECT_EQ(read(directory().file("values.csv")),
              "figure,knowledge,window,value\nfigure5,kb1,0,-1.0000\nfigure5,kb1,1,\nfigure5,kb1,2,0.0000\n");
    EXPECT_EQ(panel.values[0], -1);
    EXPECT_TRUE(std::isnan(panel.values[1]));
    EXPECT_EQ(panel.values[2], 0);
}

TEST_F(ReplayFiles, of_the_first_release_have_windows_that_fit_and_marks_for_those_not_found) {
    EXPECT_EQ(former_panel(41, "kb1", {"1", "2"}).window_length, 20) << "the usual length";
    EXPECT_EQ(former_panel(59, "kb1", {"1"}).window_length, 59);
    EXPECT_EQ(former_panel(60, "kb1", {"1", "1", "1", "1"}).window_length, 15);
    std::vector<double> const of_one = former_panel(60, "kb1", {"-1.0000", "0.0000", "-0.5"}).values;
    EXPECT_TRUE(std::isnan(of_one[0]));
    EXPECT_EQ(of_one[1], 0);
    EXPECT_EQ(of_one[2], -0.5);
    std::vector<double> const product = former_panel(60, "kb1*kb2", {"0.0000", "-1.0000", "2"}).values;
    EXPECT_TRUE(std::isnan(product[0]));
    EXPECT_EQ(product[1], -1);
}

TEST_F(ReplayStepTest, simulates_runs_in_another_world) {
    std::string const library = test::c_world("pendulum");
    write("small.toml", read(scratch.file("small.toml"))
                            .replace(0, std::string{"name = \"experiment\"\ntask = \"source\""}.size(),
                                     "name = \"experiment\"\n[world]\nlibrary = \"" + library + "\""));
    make_run("source/001", "00000000000000aa", {library, "", ""});
    make_knowledge();
    make_replays(plan(), directory(), directory());
    Replays const shown = read_replays(directory());
    ASSERT_EQ(shown.replays.size(), 1u);
    RunDirectory const run = open_run(directory().run("source/001"));
    EXPECT_EQ(shown.replays[0].scene, scene_of(*run.world.world));
    EXPECT_EQ(shown.replays[0].reward_unit, run.world.world->facts().reward_unit);
    EXPECT_EQ(shown.replays[0].steps.size(), 400u);
    ASSERT_EQ(shown.panels.size(), 2u);
    EXPECT_EQ(shown.panels[0].values.size(), 20u);
}

TEST_F(ReplayStepTest, keeps_positions_rewards_and_the_scene_of_other_worlds) {
    double const none = std::numeric_limits<double>::quiet_NaN();
    Replay const replay{"source/001",
                        "00000000000000aa",
                        "cos",
                        {2, 1, "<g id=\"pole\"/>"},
                        {{0.5f, 0.001f, 0}, {0.625f, 0.25f, -1.5}},
                        {}};
    write_replays(directory(), {{replay}, {{"figure5", "kb1", {-0.0000125, none}, "c"}}});
    EXPECT_EQ(read(directory().file("replay.csv")),
              "replay,step,x,y,reward\nsource/001,0,0.5,0.001,0\nsource/001,1,0.625,0.25,-1.5\n");
    Replays const shown = read_replays(directory());
    ASSERT_EQ(shown.replays.size(), 1u);
    EXPECT_EQ(shown.replays[0].scene, replay.scene);
    EXPECT_EQ(shown.replays[0].reward_unit, "cos");
    EXPECT_FALSE(shown.replays[0].arena);
    ASSERT_EQ(shown.replays[0].steps.size(), 2u);
    EXPECT_EQ(shown.replays[0].steps[0].y, 0.001f);
    EXPECT_EQ(shown.replays[0].steps[1].reward, -1.5);
    ASSERT_EQ(shown.panels.size(), 1u);
    EXPECT_EQ(shown.panels[0].values[0], -0.0000125) << "with all its digits";
    EXPECT_TRUE(std::isnan(shown.panels[0].values[1]));
}

TEST_F(ReplayStepTest, leaves_out_a_scene_of_a_file_that_is_no_svg) {
    Replay const replay{"source/001", "00000000000000aa", "cos", {2, 1, "</svg><script>"}, {{0.5f, 0.5f, 0}}, {}};
    write_replays(directory(), {{replay}, {}});
    EXPECT_EQ(read_replays(directory()).replays.at(0).scene, (Scene{2, 1, ""}));
}
