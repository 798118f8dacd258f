// Founders from elsewhere: clones of a knowledge base and another run's last population, on any number of ranks.

#include "system/evolve_command.h"

#include <lore/archive/container.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/collectball/collectball.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

/// A small source run, its knowledge base and founders cloned from it.
class Founders : public SystemTest {
protected:
    Founders() {
        expect_done(evolve(config, source));
        expect_done({program("lore-kb"), "build", source, "--out", base, "-q"});
        expect_done({program("lore-kb"), "clone", base, "--count", "10", "--windows", "30", "--out", clones, "-q"});
    }
    std::string signature_of(std::string const& run, std::vector<std::string> const& more, int ranks = 0) {
        auto const launcher = ranks > 0 ? on_ranks(ranks) : std::vector<std::string>{};
        return signature_of_run(launcher + evolve(config, scratch.file(run), more));
    }

    std::string config = small_config(scratch, 20);
    std::string source = scratch.file("source"), base = scratch.file("kb.lorekb"), clones = scratch.file("clones.lore");
};

}   // namespace

TEST_F(Founders, give_the_same_run_on_any_number_of_ranks_and_under_any_spelling) {
    for (std::string const& from : {clones, source}) {
        std::string const name = from == clones ? "c" : "p";
        std::string const expected = signature_of(name + "1", {"--founders", from});
        EXPECT_EQ(signature_of(name + "2", {"--founders", from}, 2), expected);
        EXPECT_EQ(results(scratch.file(name + "1")), results(scratch.file(name + "2")));
        EXPECT_EQ(signature_of(name + "3", {"--set", "founders.from=" + from}), expected);
        EXPECT_NE(signature_of(name + "4", {"--founders", from, "--set", "founders.share=0.5"}), expected);
        EXPECT_NE(signature_of(name + "5", {"--founders", from, "--set", "founders.mutate=false"}), expected);
        EXPECT_NE(signature_of(name + "6", {}), expected);
    }
    EXPECT_THAT(file_text(scratch.file("c1/manifest.json")), HasSubstr("\"kind\": \"clones of a knowledge base\""));
    EXPECT_THAT(file_text(scratch.file("p1/manifest.json")), HasSubstr("\"kind\": \"last population of a run\""));
    Command told{scratch, {program("lore-kb"), "verify", scratch.file("p1/lineage.lore")}};
    EXPECT_EQ(told.wait(), 0);
    EXPECT_THAT(told.out(), HasSubstr("founders from last population of a run (" + source + "/lineage.lore"));
}

TEST_F(Founders, of_a_knowledge_base_are_cloned_by_the_seed_of_the_run) {
    std::string const by_hand = scratch.file("by_hand.lore");
    expect_done({program("lore-kb"), "clone", base, "--count", "10", "--seed", "3", "--out", by_hand, "-q"});
    std::string const set = "evolution.population=10";
    EXPECT_EQ(signature_of("a", {"--founders", base, "--seed", "3", "--set", set}),
              signature_of("b", {"--founders", by_hand, "--seed", "3", "--set", set}))
        << "as many clones as survivors";
    EXPECT_NE(signature_of("c", {"--founders", base, "--seed", "4", "--set", set}),
              signature_of("d", {"--founders", by_hand, "--seed", "4", "--set", set}));
    EXPECT_EQ(signature_of("e", {"--founders", base, "--seed", "3", "--set", set}, 2),
              signature_of("b2", {"--founders", by_hand, "--seed", "3", "--set", set}));
}

TEST_F(Founders, of_several_origins_share_alike_on_any_ranks) {
    std::string const other = scratch.file("other.lore"), run = scratch.file("b");
    expect_done({program("lore-kb"), "clone", base, "--count", "10", "--seed", "2", "--out", other, "-q"});
    std::string const plain = "founders.mutate=false";
    std::string const expected = signature_of("a", {"--founders", clones, other, source, "--set", plain});
    EXPECT_EQ(signature_of("b", {"--founders", clones, other, source, "--set", plain}, 2), expected);
    EXPECT_EQ(results(scratch.file("a")), results(run));
    EXPECT_NE(signature_of("c", {"--founders", other, clones, source, "--set", plain}), expected);
    std::string const list = fmt::format("founders.from=['{}', '{}', '{}']", clones, other, source);
    EXPECT_EQ(signature_of("d", {"--set", list, "--set", plain}), expected);

    // A population of 16 takes 6 genomes from each: founder i is number i / 3 of origin i mod 3, again from the first
    // after 18.
    signature_of("start", {"--founders", clones, other, source, "--set", plain, "--set", "evolution.generations=0"});
    LineageArchive const lineage = read_lineage(scratch.file("start/lineage.lore"));
    EXPECT_EQ(lineage.founders->kind, "several kinds");
    EXPECT_EQ(lineage.founders->path, clones + ", " + other + ", " + source + "/lineage.lore");
    std::vector<std::vector<Genome>> origins{read_founders(clones).genomes, read_founders(other).genomes, {}};
    LineageArchive const parents = read_lineage(source + "/lineage.lore");
    for (IndividualId const id : parents.last_population) origins[2].push_back(parents.find(id)->genome);
    ASSERT_EQ(lineage.births.size(), 16u);
    for (auto const& birth : lineage.births) {
        std::uint32_t const slot = birth->id.slot;
        EXPECT_EQ(birth->genome, origins[slot % 3][slot % 18 / 3]) << slot;
    }
}

TEST_F(Founders, of_several_origins_are_those_that_a_resumed_run_was_started_with) {
    std::string const other = scratch.file("other.lore"), run = scratch.file("run"), never = scratch.file("never");
    expect_done({program("lore-kb"), "clone", base, "--count", "10", "--seed", "2", "--out", other, "-q"});
    Command start{scratch, evolve(config, run, {"--founders", clones, other, "--max-time", "0"})};
    EXPECT_EQ(start.wait(), 75) << start.err();
    expect_refusal(evolve(config, run, {"--resume", "--founders", clones}), 2,
                   "it was started with those of " + clones + ", " + other);
    expect_refusal(evolve(config, run, {"--resume", "--founders", other, clones}), 2,
                   "Give those with --founders in the order of the start: " + clones + ", " + other);
    EXPECT_EQ(signature_of("run", {"--resume", "--founders", clones, other}),
              signature_of("whole", {"--founders", clones, other}));
    EXPECT_EQ(
        signature_of_run({program("lore-evolve"), "--out", scratch.file("last"), "--founders", clones, other, config}),
        signature_of("first", {"--founders", clones, other}));
    expect_refusal(evolve(config, never, {"--founders", clones, other, clones}), 2, clones + " is named twice");
    expect_refusal(evolve(config, never, {"--founders", clones, other, "--set", "founders.share=0.03"}), 2,
                   "2 origins share 1 founders");
    std::vector<std::string> many{"--founders"};
    for (int i = 0; i < 201; ++i) many.push_back(scratch.file(fmt::format("clones{}.lore", i)));
    expect_refusal(evolve(config, never, many), 2, "a run takes them from 200 at most");
    EXPECT_FALSE(exists(never));
}

TEST_F(Founders, of_a_knowledge_base_are_cloned_again_where_a_run_is_killed_before_its_first_checkpoint) {
    std::vector<std::string> const as{"--founders", base, "--seed", "3"};
    std::string const expected = signature_of("whole", as), run = scratch.file("run");
    Command start{scratch, evolve(config, run, {"--founders", base, "--seed", "3", "--max-time", "0"})};
    EXPECT_EQ(start.wait(), 75) << start.err();
    for (char const* const late : {"run/checkpoint.lore", "run/checkpoint-older.lore"})
        std::filesystem::remove(scratch.file(late));
    EXPECT_EQ(signature_of("run", {"--founders", base, "--seed", "3", "--resume"}), expected);
}

TEST_F(Founders, are_needed_no_more_once_generation_0_is_past) {
    std::string const whole = scratch.file("whole"), stopped = scratch.file("stopped");
    std::string const expected = signature_of("whole", {"--founders", clones});
    Command start{scratch, evolve(config, stopped, {"--founders", clones, "--max-time", "0"})};
    EXPECT_EQ(start.wait(), 75) << start.err();
    std::filesystem::rename(clones, scratch.file("moved.lore"));
    EXPECT_EQ(signature_of("stopped", {"--founders", clones, "--resume"}), expected);
    EXPECT_EQ(results(stopped), results(whole));
}

TEST_F(Founders, of_a_run_are_needed_no_more_once_generation_0_is_past_though_its_directory_is_gone) {
    std::string const expected = signature_of("whole", {"--founders", clones, source});
    Command start{scratch, evolve(config, scratch.file("stopped"), {"--founders", clones, source, "--max-time", "0"})};
    EXPECT_EQ(start.wait(), 75) << start.err();
    std::filesystem::remove_all(source);
    EXPECT_EQ(signature_of("stopped", {"--founders", clones, source, "--resume"}), expected);
}

TEST_F(Founders, of_a_resumed_run_are_those_it_was_started_with) {
    std::string const run = scratch.file("run"), moved = scratch.file("moved.lore"), other = scratch.file("other.lore");
    expect_done(
        {program("lore-kb"), "clone", base, "--count", "10", "--windows", "30", "--seed", "2", "--out", other, "-q"});
    std::filesystem::copy_file(clones, moved);
    Command start{scratch, evolve(config, run, {"--founders", clones, "--max-time", "0"})};
    EXPECT_EQ(start.wait(), 75) << start.err();
    expect_refusal(evolve(config, run, {"--resume", "--founders", other}), 2, "not the file it was started with");
    expect_refusal(evolve(config, run, {"--resume"}), 2, "it was started with those of " + clones);
    expect_refusal(evolve(config, run, {"--resume", "--founders", clones, "--set", "founders.share=0.5"}), 2,
                   "it was started with founders.share = 1, not 0.5");
    Command random{scratch, evolve(config, scratch.file("random"), {"--max-time", "0"})};
    EXPECT_EQ(random.wait(), 75) << random.err();
    expect_refusal(evolve(config, scratch.file("random"), {"--resume", "--founders", clones}), 2,
                   "it was started with random ones");
    EXPECT_EQ(signature_of("run", {"--resume", "--founders", moved}), signature_of("whole", {"--founders", clones}));

    // Killed before the first checkpoint, generation 0 is made again.
    for (char const* const late : {"run/checkpoint.lore", "run/checkpoint-older.lore"})
        std::filesystem::remove(scratch.file(late));
    std::filesystem::copy_file(other, clones, std::filesystem::copy_options::overwrite_existing);
    expect_refusal(evolve(config, run, {"--resume", "--founders", clones}), 2, "not the file it was started with");
}

TEST_F(Founders, of_another_robot_are_refused_and_nothing_is_written) {
    Bytes payload = read_container(clones, FileKind::founders).bytes;
    std::string_view const ours = "range_right";
    auto const channel = std::search(payload.begin(), payload.end(), ours.begin(), ours.end(),
                                     [](std::byte stored, char wanted) { return stored == std::byte(wanted); });
    ASSERT_NE(channel, payload.end());
    *channel = std::byte{'b'};
    std::string const foreign = scratch.file("foreign.lore"), never = scratch.file("never");
    write_container(foreign, FileKind::founders, payload);
    for (auto const& launcher : {std::vector<std::string>{}, on_ranks(2)})
        expect_refusal(launcher + evolve(config, never, {"--founders", foreign}), 2,
                       "is continuous 'bange_right', not continuous 'range_right'");
    EXPECT_FALSE(exists(never));
    expect_done({program("lore-kb"), "verify", foreign});
}

TEST_F(Founders, of_a_base_with_windows_too_long_to_clone_from_are_refused_and_nothing_is_written) {
    KnowledgeConfig config_of_base;
    config_of_base.window_length = longest_window;
    config_of_base.channels = collectball_channels();
    KnowledgeArrays arrays{std::vector<std::uint16_t>(longest_window),
                           std::vector<float>(std::size_t{longest_window} * 6),
                           {2.0},
                           {4.0},
                           {2}};
    std::string const longest = scratch.file("long.lorekb"), never = scratch.file("never");
    write_knowledge_base(longest, KnowledgeBase{config_of_base, {}, std::move(arrays)});
    std::string const says = "400 windows a founder were asked for";
    expect_refusal(evolve(config, never, {"--founders", longest}), 2, says);
    expect_refusal({program("lore-kb"), "clone", longest, "--out", never}, 2, says);
    EXPECT_FALSE(exists(never));
}

TEST_F(Founders, that_do_not_fit_are_refused_and_nothing_is_written) {
    std::string const never = scratch.file("never"), deep = scratch.file("deep.lore");
    expect_done(
        {program("lore-kb"), "clone", base, "--count", "2", "--windows", "5", "--hidden", "15", "--out", deep, "-q"});
    expect_refusal(evolve(config, never, {"--founders", deep}), 2, "261 connections, limits.max_edges is 250");
    expect_refusal(evolve(config, never, {"--founders", deep, "--set", "limits.max_hidden=14"}), 2,
                   "15 hidden neurons, limits.max_hidden is 14");
    expect_refusal(evolve(config, never, {"--founders", scratch.file("missing")}), 2, "no such file");
    expect_refusal(evolve(config, never, {"--founders", scratch.path()}), 2, "there is no lineage.lore");
    EXPECT_FALSE(exists(never));
    signature_of("deep", {"--founders", deep, "--set", "limits.max_edges=300"});
}
