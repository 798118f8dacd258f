#include <lore/experiment/run_world.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>
#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <map>

using namespace lore;

namespace {

ExperimentConfig parse(std::string const& text, std::vector<std::string> const& overrides = {}) {
    return parse_config(text, "a.toml", "jobs", overrides);
}

std::string complaint(std::string const& text, std::vector<std::string> const& overrides = {}) {
    return test::complaint_of<UsageError>([&] { parse(text, overrides); });
}

}   // namespace

TEST(Config, of_an_empty_file_is_the_paper_s) {
    ExperimentConfig const config = parse("");
    EXPECT_EQ(config.episode.steps, 4000);
    EXPECT_EQ(config.evolution.population, 200);
    EXPECT_EQ(config.evolution.founders, 400);
    EXPECT_EQ(config.evolution.generations, 4000);
    EXPECT_EQ(config.knowledge.window_length, 20);
    EXPECT_EQ(config.knowledge.match_threshold, 1.83f);
    EXPECT_TRUE(differing_settings(config, ExperimentConfig{}).empty());
}

TEST(Config, comes_back_from_its_own_text_whatever_its_values) {
    for (std::uint32_t slot = 0; slot < 200; ++slot) {
        Stream rng{1, Purpose::test, 0, slot};
        ExperimentConfig config;
        config.name = slot % 3 == 0 ? "with \"quotes\" \\ and a tab\t" : "plain";
        config.arena = slot % 2 == 0 ? "collectball" : "/some/where.toml";
        config.evolution.population = 2 * static_cast<int>(1 + rng.below(100));
        config.evolution.founders = config.evolution.population + static_cast<int>(rng.below(100));
        config.evolution.ties = static_cast<TieRule>(rng.below(3));
        config.evolution.use_diversity = rng.coin();
        config.evolution.mutation.weight_probability = rng.uniform();
        config.evolution.mutation.eta = (1 << rng.below(6)) - 1;
        config.evolution.distance_schedule.distances = {static_cast<DistanceKind>(rng.below(distance_kinds)),
                                                        static_cast<DistanceKind>(rng.below(distance_kinds))};
        config.knowledge.match_threshold = static_cast<float>(rng.uniform(0.1, 10));
        config.checkpoint_minutes = rng.uniform() * 100;
        ExperimentConfig const back = parse(to_toml(config));
        EXPECT_TRUE(differing_settings(back, config).empty()) << text(differing_settings(back, config));
        EXPECT_EQ(back.evolution.mutation.weight_probability, config.evolution.mutation.weight_probability);
        EXPECT_EQ(back.knowledge.match_threshold, config.knowledge.match_threshold);
        EXPECT_EQ(back.name, config.name);
        EXPECT_EQ(to_toml(back), to_toml(config));
    }
}

TEST(Config, takes_overrides_with_and_without_quotes_and_brackets) {
    ExperimentConfig const config =
        parse("[evolution]\ngenerations = 7\n", {"evolution.generations=9", "evolution.ties=older", "task='target'",
                                                 "diversity.distances=hamming,entropy", "name=a b"});
    EXPECT_EQ(config.evolution.generations, 9);
    EXPECT_EQ(config.evolution.ties, TieRule::older);
    EXPECT_EQ(config.task, "target");
    EXPECT_EQ(config.name, "a b");
    EXPECT_EQ(config.evolution.distance_schedule.distances,
              (std::vector{DistanceKind::hamming, DistanceKind::entropy}));
    EXPECT_EQ(parse("", {"diversity.distances=[\"adhoc\"]"}).evolution.distance_schedule.distances,
              std::vector{DistanceKind::adhoc});
}

TEST(Config, names_the_line_and_the_nearest_key_of_a_mistyped_one) {
    EXPECT_EQ(complaint("[evolution]\n\ngeneratoins = 5\n"),
              "a.toml, line 3: evolution.generatoins (unknown key). Did you mean 'evolution.generations'?");
    EXPECT_EQ(complaint("generations = 5\n"),
              "a.toml, line 1: generations (unknown key). Did you mean 'evolution.generations'?");
    EXPECT_EQ(complaint("[evolutoin]\npopulation = 4\n"),
              "a.toml, line 1: evolutoin (unknown key). Did you mean 'evolution'?");
    EXPECT_EQ(complaint("", {"evolution.generation=5"}),
              "--set evolution.generation=5 (unknown key). Did you mean 'evolution.generations'?");
    EXPECT_EQ(complaint("", {"generations=5"}),
              "--set generations=5 (unknown key). Did you mean 'evolution.generations'?");
}

TEST(Config, names_the_keys_of_a_section_that_is_set_as_one) {
    EXPECT_EQ(complaint("", {"episode=3"}), "--set episode=3 (episode is a section; its keys are steps, "
                                            "stop_when_still). Write one of them, like --set episode.steps=...");
}

TEST(Config, refuses_values_of_another_type_or_out_of_range) {
    EXPECT_EQ(complaint("[evolution]\npopulation = 1\n"),
              "a.toml, line 2: evolution.population (1 is outside 2 .. 100000). Take a number from 2 to 100000.");
    EXPECT_EQ(complaint("[evolution]\npopulation = \"many\"\n"),
              "a.toml, line 2: evolution.population (a whole number is expected). Correct it.");
    EXPECT_EQ(complaint("[mutation]\nweight_probability = 1.5\n"),
              "a.toml, line 2: mutation.weight_probability (1.5 is outside 0 .. 1). Take a number from 0 to 1.");
    EXPECT_EQ(complaint("[mutation]\nweight_probability = nan\n"),
              "a.toml, line 2: mutation.weight_probability (the value is not finite). Correct it.");
    for (char const* const bad :
         {"[evolution]\nties = \"none\"\n", "[diversity]\ndistances = []\n", "[diversity]\ndistances = [\"cosine\"]\n",
          "evolution = 3\n", "[evolution]\nfounders = 100\n", "[mutation]\neta = 14\n",
          "[knowledge]\nwindow_length = 5000\n", "[knowledge]\nmatch_threshold = 0\n", "[episode]\nsteps = 0\n",
          "name = \n", "[evolution\n", "[evolution]\ngenerations = 99999999999999999999\n"})
        EXPECT_NE(complaint(bad), "") << bad;
    for (char const* const bad :
         {"evolution.generations", "=5", "evolution.generations=", "evolution.generations=5\nname='x'"})
        EXPECT_NE(complaint("", {bad}), "") << bad;
}

TEST(Config, names_no_line_of_an_override_and_says_what_is_wrong_once) {
    EXPECT_EQ(complaint("", {"evolution.population=1"}),
              "--set evolution.population=1: evolution.population (1 is outside 2 .. 100000). Take a number from 2 to "
              "100000.");
    EXPECT_EQ(
        complaint("", {"evolution.generations=abc"}),
        "--set evolution.generations=abc (Error while parsing value: could not determine value type). Give a number, "
        "true, false, a text in quotes or a list.");
    EXPECT_EQ(
        complaint("", {"evolution.fronts=none"}),
        "--set evolution.fronts=none: evolution.fronts ('none' is not a rule for fronts: known are dominance, sweep). "
        "Correct the name.");
}

TEST(Config, says_where_a_value_came_from_that_does_not_go_with_the_others) {
    EXPECT_EQ(complaint("", {"evolution.founders=7"}), "a.toml with --set evolution.founders=7: evolution.founders (7 "
                                                       "is less than the population of 200). Take at least as many.");
}

TEST(Config, looks_for_founders_beside_itself_and_where_an_override_is_typed) {
    using Paths = std::vector<std::string>;
    EXPECT_EQ(parse("").founders_from, Paths{});
    EXPECT_EQ(parse("[founders]\nfrom = \"\"").founders_from, Paths{});
    EXPECT_EQ(parse("[founders]\nfrom = \"runs/s1\"").founders_from, Paths{"jobs/runs/s1"});
    EXPECT_EQ(parse("[founders]\nfrom = \"/runs/s1\"").founders_from, Paths{"/runs/s1"});
    EXPECT_EQ(parse("[founders]\nfrom = [\"a\", \"/b\"]").founders_from, (Paths{"jobs/a", "/b"}));
    EXPECT_EQ(parse("", {"founders.from=f.lore"}).founders_from, Paths{"f.lore"});
    EXPECT_EQ(parse("", {"founders.from=a, b.lore"}).founders_from, Paths{"a, b.lore"});
    EXPECT_EQ(parse("", {"founders.from=['a', 'b']"}).founders_from, (Paths{"a", "b"}));
    EXPECT_EQ(parse("", {"founders.from=o'brien\\k.lorekb"}).founders_from, Paths{"o'brien\\k.lorekb"});
    EXPECT_NE(complaint("[founders]\nshare = 1.5\n"), "");
    EXPECT_NE(complaint("[founders]\nmutate = 1\n"), "");
}

TEST(Config, writes_founders_from_one_place_as_a_path_and_from_several_as_a_list) {
    ExperimentConfig config;
    EXPECT_NE(to_toml(config).find("from = \"\" "), std::string::npos);
    config.founders_from = {"/a"};
    EXPECT_NE(to_toml(config).find("from = \"/a\" "), std::string::npos);
    config.founders_from = {"/a", "/b"};
    EXPECT_NE(to_toml(config).find("from = [\"/a\", \"/b\"] "), std::string::npos);
    EXPECT_EQ(parse(to_toml(config)).founders_from, config.founders_from);
}

TEST(Config, looks_for_an_arena_file_beside_itself_and_leaves_names_alone) {
    EXPECT_EQ(parse("arena = \"arenas/a.toml\"").arena, "jobs/arenas/a.toml");
    EXPECT_EQ(parse("arena = \"/arenas/a.toml\"").arena, "/arenas/a.toml");
    EXPECT_EQ(parse("arena = \"collectball\"").arena, "collectball");
}

TEST(Config, that_cannot_be_read_is_an_error_of_usage) {
    Scratch const scratch;
    EXPECT_THROW(read_config(scratch.file("missing.toml")), UsageError);
    EXPECT_THROW(read_config(scratch.path()), UsageError);
}

TEST(Config, is_told_from_a_campaign_of_either_kind) {
    for (std::string const text : {"title = \"a\"\n[[treatment]]\nname = \"none\"\n", "title = \"a\"\n[transfer]\n"})
        try {
            parse_config(text, "a.toml", "");
            FAIL() << text;
        } catch (UsageError const& error) {
            EXPECT_TRUE(std::string{error.what()}.starts_with("a.toml (it is a campaign, not")) << error.what();
        }
}

TEST(Config, and_its_arena_are_found_where_they_have_moved) {
    Scratch const scratch;
    std::filesystem::create_directories(scratch.file("jobs/tasks/arenas"));
    write_file_atomically(scratch.file("jobs/tasks/arenas/room.toml"), "");
    write_file_atomically(scratch.file("jobs/tasks/mine.toml"), "arena = \"arenas/room.toml\"");
    ConfigFile const moved = read_config_file(scratch.file("jobs/mine.toml"));
    EXPECT_EQ(moved.path, scratch.file("jobs/tasks/mine.toml"));
    EXPECT_EQ(parse_config(moved).arena, scratch.file("jobs/tasks/arenas/room.toml"));
    write_file_atomically(scratch.file("jobs/own.toml"), "arena = \"arenas/room.toml\"");
    EXPECT_EQ(read_config(scratch.file("jobs/own.toml")).arena, scratch.file("jobs/tasks/arenas/room.toml"));
}

TEST(Config, files_of_the_project_are_the_paper_s_runs) {
    for (char const* const task : {"source", "target"}) {
        ExperimentConfig const config = read_config(std::string{LORE_SOURCE_DIR} + "/jobs/tasks/" + task + ".toml");
        EXPECT_EQ(config.task, task);
        ExperimentConfig expected;
        expected.name = expected.task = task;
        expected.arena = config.arena;
        EXPECT_TRUE(differing_settings(config, expected).empty());
        EXPECT_EQ(open_run_world(config, arena_text_of(config)).world->facts().task, task);
    }
}

TEST(Config, survives_every_cut_and_many_changes_of_its_text) {
    std::string const text = to_toml({});
    for (std::size_t length = 0; length < text.size(); ++length) complaint(text.substr(0, length));
    for (std::size_t at = 0; at < text.size(); at += 3)
        for (char const c : {'\0', '"', '\xff', '[', '\n', '='}) {
            std::string changed = text;
            changed[at] = c;
            complaint(changed);
        }
}

TEST(Config, reads_a_threshold_of_the_squared_distance_as_its_root) {
    ExperimentConfig const config = parse_config("[knowledge]\nsquared_threshold = 1.83\n", "a.toml", "");
    EXPECT_FLOAT_EQ(config.knowledge.match_threshold, 1.3527749f);
    EXPECT_FLOAT_EQ(config.knowledge.squared_threshold(), 1.83f);
    ExperimentConfig const again = parse_config(to_toml(config), "b.toml", "");
    EXPECT_EQ(again.knowledge, config.knowledge);
    EXPECT_EQ(parse_config("", "a.toml", "").knowledge.match_threshold, 1.83f);
}

TEST(Config, refuses_two_orders_of_equals_at_once) {
    EXPECT_THROW(parse_config("[evolution]\nties = \"insertion\"\n[shaping]\nuse = \"ties\"\n", "a.toml", ""),
                 UsageError);
}

TEST(Config, has_the_predecessors_decisions_as_settings_that_affect_results) {
    for (char const* const setting :
         {"evolution.ties=insertion", "evolution.fronts=sweep", "evolution.ends_among_equals=true",
          "evolution.prune=true", "knowledge.squared_threshold=1.83"})
        EXPECT_NE(result_settings(parse_config("", "a.toml", "", {setting})), "") << setting;
}

TEST(Config, names_a_world_with_settings_that_come_back_and_can_be_overridden) {
    std::string const text = "[world]\nlibrary = \"pendulum\"\n[world.settings]\ntask = \"short_pole\"\nlength = 1.5\n";
    ExperimentConfig const config = parse_config(text, "a.toml", "/jobs");
    EXPECT_TRUE(config.has_world());
    EXPECT_EQ(config.world.name, "pendulum");
    EXPECT_EQ(config.world.folder, "/jobs");
    EXPECT_EQ(config.world.settings, "length = 1.5\ntask = \"short_pole\"\n");
    ExperimentConfig const back = parse(to_toml(config));
    EXPECT_TRUE(differing_settings(back, config).empty()) << lore::text(differing_settings(back, config));
    EXPECT_EQ(to_toml(config).find("\narena = "), std::string::npos) << "the run is in none";
    EXPECT_EQ(to_toml(config).find("\ntask = \"source\""), std::string::npos);
    ExperimentConfig const longer = parse(text, {"world.settings.length=2", "world.settings.mass=0.5"});
    EXPECT_EQ(longer.world.settings, "length = 2\nmass = 0.5\ntask = \"short_pole\"\n");
    ExperimentConfig const words = parse(text, {"world.settings.task=long_pole", "world.settings.free=true"});
    EXPECT_EQ(words.world.settings, "free = true\nlength = 1.5\ntask = \"long_pole\"\n");
    EXPECT_EQ(parse(text, {"world.settings.length.least=1"}).world.settings,
              "length.least = 1\ntask = \"short_pole\"\n")
        << "no number any more";
    EXPECT_EQ(parse(text, {"world.settings.length.least=1", "world.settings.length=3"}).world.settings,
              "length = 3\ntask = \"short_pole\"\n");
    EXPECT_EQ(differing_result_settings(longer, config).size(), 1u) << "what the library is told affects results";
    EXPECT_FALSE(parse("").has_world());
}

TEST(Config, names_a_process_with_its_arguments_and_patience) {
    ExperimentConfig const config = parse_config("[world]\nprocess = [\"python3\", \"mine.py\"]\npatience = 2.5\n"
                                                 "[world.settings]\na = 1\n",
                                                 "a.toml", "/jobs");
    EXPECT_EQ(config.world.name, "");
    EXPECT_EQ(config.world.process, (std::vector<std::string>{"python3", "mine.py"}));
    EXPECT_EQ(config.world.patience, 2.5);
    EXPECT_EQ(config.world.settings, "a = 1\n");
    EXPECT_EQ(config.world.folder, "/jobs");
    EXPECT_EQ(parse("[world]\nprocess = [\"mine\"]\n").world.patience, 60);
    // As a run's config.toml has it.
    EXPECT_EQ(
        parse("[world]\nlibrary = \"/w/mine.so\"\nprocess = []\npatience = 60.0\nfolder = \"/w\"\nsettings = {}\n")
            .world.folder,
        "/w");
}

TEST(Config, refuses_a_world_of_both_kinds_and_what_belongs_to_none) {
    for (auto const& [text, saying] : std::map<std::string, std::string>{
             {"[world]\nprocess = [\"\"]\n", "it names no program"},
             {"[world]\nprocess = \"mine.py\"\n", "an array of strings is expected"},
             {"[world]\nprocess = [\"a\"]\nlibrary = \"b\"\n", "world.process (the world is a library already)"},
             {"[world]\nlibrary = \"b\"\npatience = 3\n", "only a process has a time limit"},
             {"[world]\nprocess = [\"a\"]\npatience = 0\n", "world.patience"},
             {"[world.settings]\nmaze = \"hard\"\n", "world.settings (no world is named"},
             {"[world]\nfolder = \"here\"\n", "world.folder (no world is named"},
             {"[world]\nlibary = \"mine\"\n", "Did you mean 'world.library'?"},
             {"world = \"mine\"\n", "a table is expected"}})
        EXPECT_NE(complaint(text).find(saying), std::string::npos) << complaint(text);
}

TEST(Config, refuses_settings_of_collectball_beside_another_world) {
    ExperimentConfig config = parse("task = \"target\"\n[world]\nlibrary = \"./no.so\"\n");
    EXPECT_NE(test::complaint_of<UsageError>([&] { open_run_world(config, ""); }).find("task is set"),
              std::string::npos);
}
