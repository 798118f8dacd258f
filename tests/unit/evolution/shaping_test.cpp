#include "synthetic_evaluator.h"

#include <lore/core/error.h>
#include <lore/evolution/evolution.h>

#include <gtest/gtest.h>

#include <set>

using namespace lore;

namespace {

Individual showing(std::vector<std::uint32_t> features) {
    Individual individual;
    individual.shown = std::make_shared<std::vector<std::uint32_t> const>(std::move(features));
    return individual;
}

EvolutionConfig shaped(ShapingUse use) {
    EvolutionConfig config;
    config.interface = {12, 3};
    config.population = 20;
    config.founders = 40;
    config.generations = 30;
    config.distance_schedule.period = 3;
    config.use_shaping = true;
    config.shaping.use = use;
    return config;
}

}   // namespace

TEST(Shares, weigh_a_feature_by_how_few_show_it) {
    // Feature 0 is shown by all four, 1 by two, 2 by one; 3 by nobody.
    std::vector<Individual> const pool{showing({0, 1}), showing({0, 1, 2}), showing({0}), showing({0})};
    std::vector<double> const values{100, 4, 8, 1000};
    EXPECT_EQ(shares(pool, values), (std::vector<double>{4 * 0.5, 4 * 0.5 + 8 * 0.75, 0, 0}));
}

TEST(Shares, of_those_who_show_nothing_are_0) {
    std::vector<Individual> const pool{showing({}), showing({0})};
    EXPECT_EQ(shares(pool, std::vector<double>{-2.0}), (std::vector<double>{0, -1}));
}

TEST(ShapingUse, objective_adds_a_third_objective) {
    SyntheticEvaluator evaluator;
    evolve(shaped(ShapingUse::objective), 1, evaluator, {}, [](GenerationReport const& report) {
        for (Individual const& member : report.state->population.members) {
            EXPECT_EQ(member.objectives.count, 3);
            EXPECT_EQ(member.objectives.value[2], member.birth->shaping);
        }
        EXPECT_FALSE(report.shaping_serves);
        return true;
    });
}

TEST(ShapingUse, distance_puts_the_shaping_value_in_the_place_of_diversity_for_some_periods) {
    SyntheticEvaluator evaluator;
    std::set<bool> seen;
    evolve(shaped(ShapingUse::distance), 1, evaluator, {}, [&](GenerationReport const& report) {
        seen.insert(report.shaping_serves);
        for (Individual const& member : report.state->population.members) {
            EXPECT_EQ(member.objectives.count, 2);
            EXPECT_EQ(member.objectives.value[1], report.shaping_serves ? member.shaping : member.diversity);
        }
        return true;
    });
    EXPECT_EQ(seen.size(), 2u);
}

TEST(ShapingUse, distance_draws_the_shaping_value_as_often_as_each_distance) {
    int served = 0;
    DistanceSchedule const config;
    for (int period = 0; period < 5000; ++period) served += shaping_serves_at(1, period * config.period, config);
    EXPECT_NEAR(served, 1000, 100);
    EXPECT_EQ(shaping_serves_at(1, 50, config), shaping_serves_at(1, 99, config)) << "a period through";
}

TEST(ShapingUse, ties_decides_among_equals_and_no_more) {
    /// All are equal but for their shaping value.
    class EqualButShaped : public ConstantEvaluator {
    public:
        std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes,
                                         CompletionListener* listener) override {
            auto evaluations = ConstantEvaluator::evaluate(genomes, listener);
            for (std::size_t i = 0; i < genomes.size(); ++i) evaluations[i].shaping = genomes[i]->biases[0];
            return evaluations;
        }
    };
    EqualButShaped evaluator;
    EvolutionConfig config = shaped(ShapingUse::ties);
    config.generations = 0;
    std::vector<double> born;
    Population const last = evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
                                for (Individual const& one : report.born) born.push_back(one.birth->shaping);
                                return true;
                            }).population;
    std::sort(born.rbegin(), born.rend());
    ASSERT_EQ(last.members.size(), 20u);
    for (std::size_t i = 0; i < last.members.size(); ++i) {
        EXPECT_EQ(last.members[i].shaping, born[i]) << "the largest values survive, in order";
        EXPECT_EQ(last.members[i].objectives.count, 2);
    }
}

TEST(ShapingUse, is_known_by_name) {
    for (ShapingUse const use : {ShapingUse::objective, ShapingUse::distance, ShapingUse::ties})
        EXPECT_EQ(shaping_use(name(use)), use);
    EXPECT_THROW(shaping_use("none"), UsageError);
}
