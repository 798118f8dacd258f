#include <lore/experiment/knowledge_building.h>

#include "support/scratch.h"
#include "support/small_run.h"

#include <lore/core/error.h>
#include <lore/evolution/lineage.h>
#include <lore/knowledge/builder.h>
#include <lore/knowledge/value.h>

#include <gmock/gmock.h>

using namespace lore;

namespace {

void expect_equal(KnowledgeBase const& a, KnowledgeBase const& b) {
    ASSERT_EQ(a.size(), b.size());
    for (int i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a.value(i), b.value(i));
        EXPECT_EQ(a.count(i), b.count(i));
        EXPECT_EQ(squared_distance(a.config().channels, a.window(i), b.window(i)), 0.0f);
    }
}

/// What a base of the run's windows has.
KnowledgeConfig config_of(RunDirectory const& run) {
    KnowledgeConfig config = run.config.knowledge;
    config.channels = run.world.record().channels;
    return config;
}

BuildingObserver const nobody = [](std::int64_t, std::int64_t) {};

}   // namespace

TEST(KnowledgeOfLineage, equals_algorithm_1_over_the_ancestors_simulated_one_by_one) {
    Scratch const scratch;
    test::write_small_run(scratch.path());
    RunDirectory const run = open_run(scratch.path());
    auto const best = run.individual("best");
    KnowledgeConfig const config = config_of(run);
    KnowledgeBuilder plain{config, make_scan_index(config)};
    for (Birth const* ancestor : lineage_of(*best)) {
        Trace const trace = record_episode(*run.world.world, compile(ancestor->genome), run.config.episode);
        plain.add_individual({windows_of(trace, config.window_length), ancestor->reward});
    }
    std::int64_t last = 0;
    Provenance provenance;
    provenance.made_by = "a test";
    KnowledgeBase const base = knowledge_of_lineage(run, *best, config, IndexKind::exact, provenance,
                                                    [&](std::int64_t done, std::int64_t) { last = done; });
    expect_equal(base, std::move(plain).finish({}));
    EXPECT_EQ(last, static_cast<std::int64_t>(lineage_of(*best).size()));
    EXPECT_EQ(base.provenance().kind, "lineage");
    EXPECT_EQ(base.provenance().made_by, "a test");
    EXPECT_EQ(base.provenance().index, "exact");
    EXPECT_EQ(base.provenance().task, "collectball source");
    EXPECT_EQ(base.provenance().sources, std::vector<std::string>{run.path});
    EXPECT_EQ(base.provenance().individuals, lineage_of(*best).size());
}

TEST(KnowledgeOfLineage, finds_the_deliveries_that_the_plain_evaluation_makes) {
    // A ball is within reach of the start, and the basket is everywhere: a robot that lets go delivers.
    Scratch const scratch;
    test::write_small_run(scratch.path());
    RunDirectory run = open_run(scratch.path());
    std::string text = arena_text_of(run.config);
    auto const replace = [&](std::string const& from, std::string const& to) {
        ASSERT_NE(text.find(from), std::string::npos) << from;
        text.replace(text.find(from), from.size(), to);
    };
    replace("reach = 20 ", "reach = 900 ");
    replace("radius = 33.75", "radius = 900");
    run.world = open_run_world(run.config, text);

    KnowledgeConfig const config = config_of(run);
    KnowledgeBuilder plain{config, make_scan_index(config), {default_gammas(), true, {}}};
    std::shared_ptr<Birth> youngest;
    for (std::uint32_t i = 0; i < 40; ++i) {
        auto birth = std::make_shared<Birth>();
        birth->id = {i, 0};
        birth->parent = youngest;
        birth->genome = founder(run.world.record().interface(), Stream{4, Purpose::founder, 0, i});
        birth->reward = record_episode(*run.world.world, compile(birth->genome), run.config.episode).reward;
        youngest = birth;
    }
    std::size_t delivered = 0;
    for (Birth const* ancestor : lineage_of(*youngest)) {
        Trace const trace = record_episode(*run.world.world, compile(ancestor->genome), run.config.episode);
        EXPECT_EQ(trace.rewards.size(), static_cast<std::size_t>(ancestor->reward));
        delivered += trace.rewards.size();
        plain.add_individual(
            {windows_of(trace, config.window_length), ancestor->reward, trace.rewards, ancestor->id.generation});
    }
    EXPECT_GT(delivered, 5u);   // 11 with these genomes
    KnowledgeBase const base = knowledge_of_lineage(run, *youngest, config, IndexKind::exact, {}, nobody);
    KnowledgeBase const expected = std::move(plain).finish({});
    expect_equal(base, expected);
    for (ValueConfig const rule : {ValueConfig{ValueRule::discounted_return, 0.99},
                                   {ValueRule::discounted_return, 0.995},
                                   {ValueRule::credit, 0}})
        EXPECT_EQ(values_by(base, rule), values_by(expected, rule));
}

TEST(KnowledgeOfAll, equals_algorithm_1_over_everybody_or_every_fifth_in_order_of_birth) {
    Scratch const scratch;
    test::write_small_run(scratch.path());
    RunDirectory const run = open_run(scratch.path());
    KnowledgeConfig const config = config_of(run);
    EXPECT_EQ(archived_individuals(run), 16u + 6 * 8);
    for (int const every : {1, 5}) {
        KnowledgeBuilder plain{config, make_scan_index(config)};
        int number = 0;
        for_each_individual(
            run.file(run_file::all_individuals), run.lineage.generation, [&](ArchivedIndividual const& individual) {
                if (number++ % every != 0) return;
                Trace const trace = record_episode(*run.world.world, compile(individual.genome), run.config.episode);
                plain.add_individual({windows_of(trace, config.window_length), individual.reward});
            });
        EXPECT_EQ(plain.individuals(), every == 1 ? 64u : 13u);
        expect_equal(knowledge_of_all(run, every, config, IndexKind::exact, {}, nobody), std::move(plain).finish({}));
    }
}

TEST(KnowledgeOfAll, says_what_is_missing_where_the_run_did_not_keep_everybody) {
    Scratch const scratch;
    test::write_small_run(scratch.path());
    std::filesystem::remove(scratch.file(run_file::all_individuals));
    RunDirectory const run = open_run(scratch.path());
    EXPECT_THROW(knowledge_of_all(run, 1, {}, IndexKind::exact, {}, nobody), Error);
}

TEST(KnowledgeOfLineage, refuses_an_individual_whose_evaluation_does_not_repeat) {
    Scratch const scratch;
    test::write_small_run(scratch.path());
    RunDirectory const run = open_run(scratch.path());
    Birth changed;
    changed.id = {3, 4};
    changed.genome = run.individual("best")->genome;
    changed.reward = 5;
    try {
        knowledge_of_lineage(run, changed, {}, IndexKind::exact, {}, nobody);
        FAIL();
    } catch (Error const& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("individual 3.4"));
        EXPECT_THAT(error.what(), ::testing::HasSubstr("does not repeat"));
    }
}

TEST(KnowledgeOfLineage, stops_cleanly_when_its_observer_throws) {
    Scratch const scratch;
    test::write_small_run(scratch.path());
    RunDirectory const run = open_run(scratch.path());
    EXPECT_THROW(knowledge_of_all(run, 1, {}, IndexKind::exact, {},
                                  [](std::int64_t, std::int64_t) { throw std::runtime_error("enough"); }),
                 std::runtime_error);
}
