#include "run_digest.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/checkpoint.h>
#include <lore/core/error.h>
#include <lore/experiment/run_directory.h>

#include <gtest/gtest.h>

using namespace lore;

namespace {

std::string const stopped_run = LORE_SOURCE_DIR "/tests/data/version-1/stopped-run/";

std::string text_of(std::string const& path) {
    auto const bytes = read_file(path);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

WorkOrder order_with(std::vector<std::string> const& overrides) {
    WorkOrder order;
    order.config = parse_config("", "a.toml", "", overrides);
    order.arena_text = "an arena";
    return order;
}

std::uint64_t digest_with(std::vector<std::string> const& overrides) { return digest_of(order_with(overrides), 1); }

}   // namespace

TEST(RunDigest, depends_on_settings_that_affect_results_arena_knowledge_base_and_seed) {
    std::uint64_t const plain = digest_with({});
    EXPECT_EQ(digest_with({"evolution.population=200"}), plain) << "that is its default";
    for (char const* const other : {"evolution.population=198", "episode.steps=3999", "task=target", "mutation.eta=7",
                                    "diversity.distances=adhoc", "evolution.ties=older"})
        EXPECT_NE(digest_with({other}), plain) << other;
    for (char const* const other :
         {"name=other", "arena=other", "evolution.generations=7", "checkpoint.generations=7", "checkpoint.minutes=7"})
        EXPECT_EQ(digest_with({other}), plain) << other;
    EXPECT_NE(digest_of(order_with({}), 2), plain);
    EXPECT_NE(digest_of(order_with({}), 1, "0123456789abcdef"), plain);
    WorkOrder order = order_with({});
    order.arena_text += " changed";
    EXPECT_NE(digest_of(order, 1), plain);
    order = order_with({});
    order.knowledge_checksum = "0123456789abcdef";
    EXPECT_NE(digest_of(order, 1), plain);
}

TEST(RunDigest, takes_settings_by_key_and_value) {
    EXPECT_EQ(result_settings({}), "");
    EXPECT_EQ(result_settings(order_with({"task=target", "episode.steps=120", "name=x"}).config),
              "episode.steps = 120\ntask = \"target\"\n");
}

/// A default that changes would make checkpoints unfit that were written under the former one.
TEST(RunDigest, finds_nothing_but_defaults_in_the_configuration_stored_with_all_defaults_of_version_1) {
    std::string const defaults = LORE_SOURCE_DIR "/tests/data/version-1/config.toml";
    EXPECT_EQ(result_settings(read_config(defaults)), "");
}

TEST(FormerRunDigest, is_that_of_a_checkpoint_written_by_commit_e8a0ef9) {
    WorkOrder order;
    order.arena_text = text_of(stopped_run + run_file::arena);
    std::string const text = text_of(stopped_run + run_file::config);
    std::uint64_t const stored = read_checkpoint(stopped_run + run_file::checkpoint, "").checkpoint.config_digest;
    EXPECT_EQ(former_digest_of(text, order, 5), stored);
    EXPECT_NE(former_digest_of(text, order, 6), stored);

    auto const with = [&](std::string_view former, std::string_view present) {
        std::string changed = text;
        changed.replace(changed.find(former), former.size(), present);
        return former_digest_of(changed, order, 5);
    };
    EXPECT_EQ(
        with("name = \"tiny\"                            #", "name = \"a # much longer name than it had before\" #"),
        stored);
    EXPECT_EQ(with("generations = 12 ", "generations = 999"), stored) << "a run may be made longer";
    EXPECT_NE(with("population = 6", "population = 8"), stored);
}

TEST(Settings, that_differ_are_told_by_key_and_both_values) {
    ExperimentConfig const ours = order_with({"episode.steps=120", "evolution.generations=5", "name=x"}).config;
    auto const all = differing_settings(ours, {});
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].affects, Affects::nothing);
    EXPECT_EQ(all[1].affects, Affects::results);
    EXPECT_EQ(all[2].affects, Affects::length);
    EXPECT_EQ(text(all), "name = \"x\", not \"source\"; episode.steps = 120, not 4000; "
                         "evolution.generations = 5, not 4000");
    EXPECT_EQ(text(differing_result_settings(ours, {})), "episode.steps = 120, not 4000");
}
