#include <lore/evolution/summary.h>

#include <gtest/gtest.h>

using namespace lore;

namespace {

Individual member(double reward, double diversity, double shaping, int edges, int hidden) {
    auto birth = std::make_shared<Birth>();
    birth->reward = reward;
    birth->shaping = shaping;
    birth->genome.interface = {12, 3};
    birth->genome.edges.resize(static_cast<std::size_t>(edges));
    birth->genome.biases.resize(static_cast<std::size_t>(3 + hidden));
    Individual individual;
    individual.birth = std::move(birth);
    auto descriptors = std::make_shared<Descriptors>();
    descriptors->channel_bits.resize(8000);
    descriptors->entropies.resize(17);   // two words a step
    individual.descriptors = std::move(descriptors);
    individual.diversity = diversity;
    individual.shaping = shaping;
    individual.objectives = {{reward, diversity, shaping}, 3};
    return individual;
}

}   // namespace

TEST(Summarize, gives_the_figures_of_a_hand_worked_generation) {
    EvolutionState state;
    state.population.members = {member(2, 0.5, 3.0, 36, 0), member(2, 0.5, 3.0, 40, 2), member(0, 0.25, 3.0, 38, 0),
                                member(4.5, 0.75, 1.5, 30, 1)};
    std::vector<Individual> const born{member(0, 0, 0, 1, 0), member(0, 0, 0, 1, 0), member(0, 0, 0, 1, 0)};
    GenerationReport report;
    report.generation = 17;
    report.distance = DistanceKind::entropy;
    report.fronts = 5;
    report.born = born;
    report.state = &state;
    GenerationSummary const summary = summarize(report);
    EXPECT_EQ(summary.generation, 17);
    EXPECT_EQ(summary.distance, DistanceKind::entropy);
    EXPECT_EQ(summary.fronts, 5);
    EXPECT_EQ(summary.best_reward, 4.5);
    EXPECT_EQ(summary.mean_reward, 2.125);
    EXPECT_EQ(summary.mean_diversity, 0.5);
    EXPECT_EQ(summary.best_shaping, 3.0);
    EXPECT_EQ(summary.mean_connections, 36.0);
    EXPECT_EQ(summary.mean_hidden, 0.75);
    EXPECT_EQ(summary.tied, 2);
    EXPECT_EQ(summary.shaping_at_max, 0.75);
    EXPECT_EQ(summary.evaluations, 3u);
    EXPECT_EQ(summary.steps, 12000u);
}

TEST(Summarize, has_the_best_shaping_also_where_all_are_negative) {
    EvolutionState state;
    state.population.members = {member(0, 0, -4.0, 36, 0), member(0, 0, -2.5, 36, 0)};
    GenerationReport report;
    report.state = &state;
    EXPECT_EQ(summarize(report).best_shaping, -2.5);
    EXPECT_EQ(summarize(report).shaping_at_max, 0.5);
}

TEST(Summarize, has_no_share_at_the_best_shaping_where_nobody_matched_a_feature) {
    EvolutionState state;
    state.population.members = {member(0, 0, no_feature_value, 36, 0), member(0, 0, no_feature_value, 36, 0)};
    GenerationReport report;
    report.state = &state;
    EXPECT_EQ(summarize(report).best_shaping, no_feature_value);
    EXPECT_EQ(summarize(report).shaping_at_max, 0.0);
    EXPECT_EQ(summarize(report).tied, 2);
}

TEST(Summarize, has_no_share_at_the_best_shaping_where_nobody_matched_a_feature_of_a_base_of_negative_values) {
    EvolutionState state;
    state.population.members = {member(0, 0, -6, 36, 0), member(0, 0, -6, 36, 0)};
    GenerationReport report;
    report.state = &state;
    double const nothing_shown = -6;   // of a base whose smallest value is -5
    EXPECT_EQ(summarize(report, nothing_shown).best_shaping, -6);
    EXPECT_EQ(summarize(report, nothing_shown).shaping_at_max, 0.0);
    state.population.members[1].shaping = -1;
    EXPECT_EQ(summarize(report, nothing_shown).shaping_at_max, 0.5) << "a value that a feature may have";
}

TEST(Summarize, has_the_best_reward_also_where_all_are_negative) {
    EvolutionState state;
    state.population.members = {member(-4, 0, 0, 36, 0), member(-2.5, 0, 0, 36, 0)};
    GenerationReport report;
    report.state = &state;
    EXPECT_EQ(summarize(report).best_reward, -2.5);
    EXPECT_EQ(summarize(report).mean_reward, -3.25);
}
