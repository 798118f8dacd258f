#include <lore/watch/events.h>

#include "support/scratch.h"

#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>
#include <lore/world/reward_text.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>

using namespace lore;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

/// Runs whose files a test writes as lore-evolve would at that time.
class Events : public ::testing::Test {
protected:
    void write_config(std::string const& run) const {
        fs::create_directories(scratch.file(run));
        std::ofstream{scratch.file(run + "/config.toml")} << to_toml(ExperimentConfig{});
    }
    void write_rows(std::string const& run, int generations, std::string_view unit = first_reward_unit) const {
        std::string table = progress_header(unit) + "\n";
        for (int g = 0; g <= generations; ++g) {
            GenerationSummary row;
            row.generation = g;
            row.best_reward = g / 2;
            row.mean_reward = 0.5 * g;
            table += text(row) + "\n";
        }
        std::ofstream{scratch.file(run + "/progress.csv")} << table;
    }
    static RunSession session(std::string started, std::string stopped, int first, int last, std::string reason) {
        RunSession session;
        session.started = std::move(started);
        session.stopped = std::move(stopped);
        session.first_generation = first;
        session.last_generation = last;
        session.reason = std::move(reason);
        return session;
    }
    void write_manifest(std::string const& run, RunStatus status, std::vector<RunSession> sessions,
                        WorldRecord world = {}) const {
        Manifest manifest;
        manifest.world = std::move(world);
        manifest.status = status;
        manifest.task = "source";
        manifest.seed = 7;
        manifest.generations = 4;
        manifest.generation = 4;
        manifest.best_reward = manifest.world.name.empty() ? 2 : -0.5;
        manifest.best = "4.11";
        manifest.signature = "0123456789abcdef";
        manifest.build.version = "1.0.0";
        manifest.sessions = std::move(sessions);
        lore::write_manifest(scratch.file(run + "/manifest.json"), manifest);
    }
    /// "generation 3" and so on.
    static std::vector<std::string> names(std::vector<std::string> const& lines) {
        std::vector<std::string> all;
        for (std::string const& line : lines) {
            json const event = json::parse(line);
            std::string name = event.at("event");
            if (name == "generation" || name == "session_ended") name += " " + event.at("generation").dump();
            all.push_back(name);
        }
        return all;
    }

    Scratch scratch;
};

TEST_F(Events, of_a_finished_run_are_its_beginning_its_generations_and_its_end) {
    write_config("r");
    write_rows("r", 4);
    write_manifest("r", RunStatus::done, {session("2026-01-31T12:00:00Z", "2026-01-31T12:00:09Z", 0, 4, "done")});
    EventReader reader{scratch.file("r"), 1};
    auto const lines = reader.look();
    EXPECT_THAT(names(lines), ElementsAre("run_begun", "session_begun", "generation 0", "generation 1", "generation 2",
                                          "generation 3", "generation 4", "session_ended 4", "run_ended"));
    json const begun = json::parse(lines.front()), third = json::parse(lines[4]), ended = json::parse(lines.back());
    EXPECT_EQ(begun.at("run"), "r");
    EXPECT_EQ(begun.at("seed"), 7);
    EXPECT_EQ(begun.at("version"), "1.0.0");
    EXPECT_TRUE(begun.at("world").is_null()) << "an earlier version did not record it";
    EXPECT_EQ(begun.at("reward_unit"), "balls");
    EXPECT_EQ(begun.at("time"), "2026-01-31T12:00:00Z");
    EXPECT_EQ(begun.at("config").at("evolution.population"), ExperimentConfig{}.evolution.population);
    EXPECT_EQ(begun.at("config").at("task"), "source");
    EXPECT_EQ(third.at("best_balls"), 1);
    EXPECT_EQ(third.at("mean_balls"), 1.0);
    EXPECT_EQ(third.at("distance"), "adhoc");
    EXPECT_EQ(ended.at("signature"), "0123456789abcdef");
    EXPECT_EQ(ended.at("best"), "4.11");
    EXPECT_EQ(ended.at("best_balls"), 2);
    EXPECT_TRUE(reader.ended());
    EXPECT_THAT(reader.look(), IsEmpty()) << "told once";
}

TEST_F(Events, of_a_run_in_another_world_have_its_reward_with_its_unit) {
    WorldRecord world;
    world.name = world.task = "toy";
    world.reward_unit = "cos";
    world.channels = {std::vector<ChannelInfo>{{"sensor"}}, std::vector<ChannelInfo>{{"effector"}}};
    write_config("r");
    write_rows("r", 1, "cos");
    write_manifest("r", RunStatus::done, {session("a", "b", 0, 1, "done")}, world);
    auto const lines = EventReader(scratch.file("r"), 1).look();
    ASSERT_THAT(names(lines), ElementsAre("run_begun", "session_begun", "generation 0", "generation 1",
                                          "session_ended 1", "run_ended"));
    json const begun = json::parse(lines.front()), row = json::parse(lines[3]), ended = json::parse(lines.back());
    EXPECT_EQ(begun.at("world"), "toy");
    EXPECT_EQ(begun.at("reward_unit"), "cos");
    EXPECT_EQ(row.at("best_reward"), 0);
    EXPECT_EQ(row.at("mean_reward"), 0.5);
    EXPECT_FALSE(row.contains("best_balls"));
    EXPECT_EQ(ended.at("best_reward"), -0.5);
}

TEST_F(Events, of_a_run_at_work_come_as_its_files_grow) {
    EventReader reader{scratch.path(), 1};
    EXPECT_THAT(reader.look(), IsEmpty()) << "there is no run yet";
    fs::create_directories(scratch.file("runs/kb1/003"));
    write_manifest("runs/kb1/003", RunStatus::running, {session("a", "", 0, 0, "")});
    EXPECT_THAT(reader.look(), IsEmpty()) << "its configuration comes after its manifest";
    write_config("runs/kb1/003");
    auto const first = reader.look();
    EXPECT_THAT(names(first), ElementsAre("run_begun", "session_begun"));
    EXPECT_EQ(json::parse(first.front()).at("run"), "kb1/003");
    write_rows("runs/kb1/003", 1);
    EXPECT_THAT(names(reader.look()), ElementsAre("generation 0", "generation 1"));
    write_rows("runs/kb1/003", 2);
    EXPECT_THAT(names(reader.look()), ElementsAre("generation 2"));
    write_manifest("runs/kb1/003", RunStatus::interrupted, {session("a", "b", 0, 2, "signal 15")});
    auto const stop = reader.look();
    EXPECT_THAT(names(stop), ElementsAre("session_ended 2"));
    EXPECT_EQ(json::parse(stop.back()).at("reason"), "signal 15");
    EXPECT_FALSE(reader.ended());
}

TEST_F(Events, tell_of_a_killed_session_when_the_next_begins_and_no_generation_twice) {
    write_config("r");
    write_rows("r", 3);
    write_manifest("r", RunStatus::running, {session("a", "", 0, 0, "")});
    EventReader reader{scratch.file("r"), 1};
    EXPECT_EQ(names(reader.look()).back(), "generation 3");
    // It was killed, and goes on from its checkpoint of generation 1.
    write_rows("r", 1);
    write_manifest("r", RunStatus::running, {session("a", "", 0, 0, ""), session("b", "", 2, 1, "")});
    auto const lines = reader.look();
    EXPECT_THAT(names(lines), ElementsAre("session_ended 1", "session_begun"));
    EXPECT_EQ(json::parse(lines.front()).at("reason"), "killed");
    EXPECT_TRUE(json::parse(lines.front()).at("time").is_null());
    write_rows("r", 4);
    EXPECT_THAT(names(reader.look()), ElementsAre("generation 4"));
}

TEST_F(Events, begin_again_for_a_run_that_was_made_again) {
    write_config("r");
    write_rows("r", 4);
    write_manifest("r", RunStatus::done, {session("a", "b", 0, 4, "done")});
    EventReader reader{scratch.file("r"), 1};
    auto const first = names(reader.look());
    write_manifest("r", RunStatus::done, {session("c", "d", 0, 4, "done")});
    EXPECT_EQ(names(reader.look()), first);
}

TEST_F(Events, can_leave_generations_out_but_not_the_last) {
    write_config("r");
    write_rows("r", 4);
    write_manifest("r", RunStatus::done, {session("a", "b", 0, 4, "done")});
    EXPECT_THAT(names(EventReader(scratch.file("r"), 3).look()),
                ElementsAre("run_begun", "session_begun", "generation 0", "generation 3", "generation 4",
                            "session_ended 4", "run_ended"));
}

TEST_F(Events, tell_the_last_generation_of_a_session_also_where_it_was_left_out_while_at_work) {
    write_config("r");
    write_rows("r", 4);
    write_manifest("r", RunStatus::running, {session("a", "", 0, 0, "")});
    EventReader reader{scratch.file("r"), 3};
    EXPECT_THAT(names(reader.look()), ElementsAre("run_begun", "session_begun", "generation 0", "generation 3"));
    write_manifest("r", RunStatus::done, {session("a", "b", 0, 4, "done")});
    EXPECT_THAT(names(reader.look()), ElementsAre("generation 4", "session_ended 4", "run_ended"));
}

TEST_F(Events, wait_for_a_manifest_that_can_be_read) {
    write_config("r");
    write_rows("r", 1);
    std::ofstream{scratch.file("r/manifest.json")} << "{";
    EventReader reader{scratch.file("r"), 1};
    EXPECT_THAT(names(reader.look()), ElementsAre("unreadable"));
    write_rows("r", 2);
    EXPECT_THAT(reader.look(), IsEmpty()) << "of no run that is known";
    write_manifest("r", RunStatus::running, {session("a", "", 0, 0, "")});
    EXPECT_THAT(names(reader.look()),
                ElementsAre("run_begun", "session_begun", "generation 0", "generation 1", "generation 2"));
}

TEST_F(Events, say_once_what_cannot_be_read) {
    write_config("r");
    write_rows("r", 1);
    std::ofstream{scratch.file("r/manifest.json")} << "{";
    EventReader reader{scratch.file("r"), 1};
    auto const lines = reader.look();
    EXPECT_THAT(names(lines), ElementsAre("unreadable"));
    EXPECT_THAT(json::parse(lines.front()).at("reason").get<std::string>(), HasSubstr("manifest.json"));
    EXPECT_THAT(reader.look(), IsEmpty());
}
