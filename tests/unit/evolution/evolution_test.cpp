#include "synthetic_evaluator.h"

#include <lore/behavior/mean_distances.h>
#include <lore/evolution/evolution.h>
#include <lore/evolution/lineage.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace lore;

namespace {

/// Of the genomes that the synthetic evaluator judges.
constexpr Interface interface { 12, 3 };

EvolutionConfig small_config() {
    EvolutionConfig config;
    config.interface = interface;
    config.population = 20;
    config.founders = 40;
    config.generations = 60;
    config.distance_schedule.period = 7;
    return config;
}

std::string signature_of(EvolutionConfig const& config, std::uint64_t seed,
                         SyntheticEvaluator::Order order = SyntheticEvaluator::Order::forward) {
    SyntheticEvaluator evaluator{order};
    return evolve(config, seed, evaluator, evaluator, {}, {}).signature.text();
}

double mean_birth(Population const& population) {
    double sum = 0;
    for (Individual const& member : population.members) sum += member.id().generation;
    return sum / static_cast<double>(population.members.size());
}

}   // namespace

TEST(Evolve, is_a_pure_function_of_configuration_and_seed) {
    EXPECT_EQ(signature_of(small_config(), 1), signature_of(small_config(), 1));
    EXPECT_NE(signature_of(small_config(), 1), signature_of(small_config(), 2));
    EvolutionConfig other = small_config();
    other.ties = TieRule::older;
    EXPECT_NE(signature_of(small_config(), 1), signature_of(other, 1));
}

TEST(FounderGenomes, are_random_where_none_are_given_whatever_the_settings_say) {
    EvolutionConfig config = small_config();
    config.founding = {0.5, false};
    auto const genomes = founder_genomes(config, 1, {});
    ASSERT_EQ(genomes.size(), 40u);
    for (std::uint32_t slot = 0; slot < 40; ++slot)
        EXPECT_EQ(genomes[slot], founder(interface, Stream{1, Purpose::founder, 0, slot}));
}

TEST(FounderGenomes, take_those_given_in_turn_and_random_ones_for_the_rest) {
    EvolutionConfig config = small_config();
    config.founding = {0.25, false};
    std::vector<Genome> const given{founder(interface, Stream{7, Purpose::test, 0, 0}),
                                    founder(interface, Stream{7, Purpose::test, 0, 1}),
                                    founder(interface, Stream{7, Purpose::test, 0, 2})};
    auto const genomes = founder_genomes(config, 1, given);
    ASSERT_EQ(genomes.size(), 40u);
    for (std::uint32_t slot = 0; slot < 40; ++slot)
        EXPECT_EQ(genomes[slot], slot < 10 ? given[slot % 3] : founder(interface, Stream{1, Purpose::founder, 0, slot}))
            << slot;
    config.founding.share = 0;
    EXPECT_EQ(founder_genomes(config, 1, given), founder_genomes(config, 1, {}));
}

TEST(FounderGenomes, are_mutated_once_each_by_a_stream_of_their_own) {
    EvolutionConfig const config = small_config();
    std::vector<Genome> const given{founder(interface, Stream{7, Purpose::test})};
    auto const genomes = founder_genomes(config, 1, given);
    for (std::uint32_t slot = 0; slot < 40; ++slot) {
        Genome expected = given[0];
        Stream rng{1, Purpose::founder_mutation, 0, slot};
        mutate(expected, config.mutation, config.limits, rng);
        EXPECT_EQ(genomes[slot], expected);
    }
    EXPECT_NE(genomes[0], genomes[1]);
    EXPECT_NE(founder_genomes(config, 2, given), genomes);
}

TEST(Evolve, starts_from_the_genomes_that_it_is_given) {
    SyntheticEvaluator evaluator;
    std::vector<Genome> const given{founder(interface, Stream{7, Purpose::test})};
    auto const signature = [&](std::span<Genome const> origin) {
        return evolve(small_config(), 1, evaluator, {}, {}, origin).signature.text();
    };
    EXPECT_EQ(signature({}), signature_of(small_config(), 1));
    EXPECT_EQ(signature(given), signature(given));
    EXPECT_NE(signature(given), signature({}));
}

TEST(Evolve, does_not_depend_on_the_order_in_which_the_work_is_done) {
    EvolutionConfig many = small_config();   // so many that distances are measured while others are under way
    many.population = 200;
    many.founders = 200;
    many.generations = 20;
    for (EvolutionConfig config : {small_config(), many}) {
        config.use_shaping = config.population == many.population;
        std::string const expected = signature_of(config, 3);
        EXPECT_EQ(signature_of(config, 3, SyntheticEvaluator::Order::backward), expected);
        EXPECT_EQ(signature_of(config, 3, SyntheticEvaluator::Order::shuffled), expected);
    }
}

TEST(Evolve, goes_on_from_any_generation_as_if_it_had_never_stopped) {
    EvolutionConfig const config = small_config();
    std::string const expected = signature_of(config, 4);
    for (int const stop : {0, 1, 6, 7, 30, 59}) {   // before and after a change of distance, too
        SyntheticEvaluator evaluator;
        EvolutionState half =
            evolve(config, 4, evaluator, {}, [&](GenerationReport const& report) { return report.generation < stop; });
        EXPECT_EQ(half.population.generation, stop);
        EvolutionState without_distances = half;
        without_distances.population.distances = {};
        EXPECT_EQ(evolve(config, 4, evaluator, std::move(half), {}).signature.text(), expected);
        EXPECT_EQ(evolve(config, 4, evaluator, std::move(without_distances), {}).signature.text(), expected);
    }
}

TEST(Evolve, of_a_finished_state_changes_nothing) {
    SyntheticEvaluator evaluator;
    EvolutionState const finished = evolve(small_config(), 5, evaluator, {}, {});
    EvolutionState const again = evolve(small_config(), 5, evaluator, finished, [](auto const&) {
        ADD_FAILURE();
        return true;
    });
    EXPECT_EQ(again.signature.value(), finished.signature.value());
    EXPECT_EQ(again.population.generation, 60);
}

TEST(Evolve, keeps_200_of_400_founders_and_then_evaluates_only_children) {
    EvolutionConfig config;
    config.interface = interface;
    config.generations = 2;
    SyntheticEvaluator evaluator;
    std::vector<std::size_t> born;
    EvolutionState const state = evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
        EXPECT_EQ(report.state->population.members.size(), 200u);
        EXPECT_EQ(report.state->population.generation, report.generation);
        born.push_back(report.born.size());
        return true;
    });
    EXPECT_EQ(born, (std::vector<std::size_t>{400, 200, 200}));
    EXPECT_EQ(evaluator.evaluated(), 800);
}

TEST(Evolve, draws_founders_and_children_from_streams_of_their_own) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config = small_config();
    config.generations = 3;
    evolve(config, 9, evaluator, {}, [&](GenerationReport const& report) {
        for (std::uint32_t slot = 0; slot < report.born.size(); ++slot) {
            Birth const& birth = *report.born[slot].birth;
            std::uint32_t const generation = static_cast<std::uint32_t>(report.generation);
            EXPECT_EQ(birth.id, (IndividualId{generation, slot}));
            if (generation == 0) {
                EXPECT_EQ(birth.parent, nullptr);
                EXPECT_EQ(birth.genome, founder(interface, Stream{9, Purpose::founder, 0, slot}));
            } else {
                Genome child = birth.parent->genome;
                Stream rng{9, Purpose::mutation, generation, slot};
                mutate(child, config.mutation, config.limits, rng);
                EXPECT_EQ(birth.genome, child);
            }
        }
        return true;
    });
}

TEST(Evolve, measures_only_pairs_with_a_child_unless_the_distance_has_changed) {
    EvolutionConfig config = small_config();
    SyntheticEvaluator evaluator;
    std::vector<DistanceKind> kinds;
    std::vector<int> expected;   // how many members' distances are known when the others' are measured
    evolve(config, 2, evaluator, evaluator, {}, [&](GenerationReport const& report) {
        bool const changes = kinds.empty() || report.distance != kinds.back();
        kinds.push_back(report.distance);
        EXPECT_EQ(report.state->population.distances.size(), is_euclidean(report.distance) ? 0 : 20);
        if (!is_euclidean(report.distance)) expected.push_back(changes ? 0 : 20);
        // Kept distances are those that a measurement of the survivors would give.
        Population const& population = report.state->population;
        for (int i = 0; i < population.distances.size(); ++i)
            for (int j = 0; j < i; ++j)
                EXPECT_EQ(population.distances(i, j), distance(report.distance, *population.members[i].descriptors,
                                                               *population.members[j].descriptors));
        return true;
    });
    EXPECT_EQ(evaluator.measured_from(), expected);
    EXPECT_EQ(std::set<DistanceKind>(kinds.begin(), kinds.end()).size(), 4u);
    for (std::size_t g = 0; g < kinds.size(); ++g)
        EXPECT_EQ(kinds[g], distance_at(2, static_cast<int>(g), config.distance_schedule));
}

TEST(Evolve, judges_diversity_in_the_joint_pool_of_its_generation) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config = small_config();
    config.generations = 10;
    config.use_shaping = true;
    std::vector<Individual> parents;
    evolve(config, 6, evaluator, {}, [&](GenerationReport const& report) {
        std::vector<Individual> pool = parents;
        pool.insert(pool.end(), report.born.begin(), report.born.end());
        for (Individual const& child : report.born) {
            double sum = 0;
            for (Individual const& other : pool)
                sum += distance(report.distance, *child.descriptors, *other.descriptors);
            EXPECT_EQ(child.diversity, sum / static_cast<double>(pool.size()));
            EXPECT_EQ(child.birth->diversity, child.diversity);
            EXPECT_EQ(child.objectives, (Objectives{{child.birth->reward, child.diversity, child.birth->shaping}, 3}));
        }
        parents = report.state->population.members;
        return true;
    });
}

TEST(Evolve, uses_the_objectives_of_the_treatment) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config = small_config();
    config.generations = 1;
    config.use_diversity = false;
    EvolutionState const reward_alone = evolve(config, 6, evaluator, {}, {});
    EXPECT_EQ(reward_alone.population.members[0].objectives.count, 1);
    EXPECT_GT(reward_alone.population.members[0].diversity, 0);
}

TEST(Evolve, raises_the_best_reward_by_more_than_3_in_200_generations) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config = small_config();
    config.generations = 200;
    double at_start = -1;
    EvolutionState const state = evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
        if (report.generation == 0) at_start = best_of_run(report.state->population).birth->reward;
        return true;
    });
    EXPECT_GT(best_of_run(state.population).birth->reward, at_start + 3);
}

TEST(Evolve, keeps_the_population_moving_when_all_objectives_tie) {
    ConstantEvaluator evaluator;
    EvolutionConfig config = small_config();
    EvolutionState const moving = evolve(config, 1, evaluator, {}, {});
    EXPECT_GT(mean_birth(moving.population), 55);   // nobody outlives a few generations of fair lots
    config.ties = TieRule::older;
    EXPECT_EQ(mean_birth(evolve(config, 1, evaluator, {}, {}).population), 0);   // stands still for ever
    config.ties = TieRule::younger;
    EXPECT_EQ(mean_birth(evolve(config, 1, evaluator, {}, {}).population), 60);
}

TEST(Evolve, remembers_no_more_than_the_living_tree) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config = small_config();
    config.generations = 300;
    std::vector<std::weak_ptr<Birth const>> everybody;
    EvolutionState const state = evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
        for (Individual const& child : report.born) everybody.push_back(child.birth);
        return true;
    });
    auto const alive =
        std::count_if(everybody.begin(), everybody.end(), [](auto const& birth) { return !birth.expired(); });
    EXPECT_EQ(static_cast<std::size_t>(alive), ancestors_of(state.population.members).size());
    EXPECT_LT(alive, 700);   // of 6040
}

TEST(BestOfRun, has_most_reward_then_the_earliest_birth_then_the_lowest_slot) {
    Population population;
    for (auto const& [reward, generation, slot] : {std::array{3, 1, 1}, {5, 9, 0}, {5, 4, 8}, {5, 4, 7}, {4, 0, 0}}) {
        auto birth = std::make_shared<Birth>();
        birth->reward = reward;
        birth->id = {static_cast<std::uint32_t>(generation), static_cast<std::uint32_t>(slot)};
        Individual member;
        member.birth = std::move(birth);
        population.members.push_back(std::move(member));
    }
    EXPECT_EQ(best_of_run(population).id(), (IndividualId{4, 7}));
}

TEST(Evolution, prunes_newborns_where_asked_to) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config;
    config.interface = interface;
    config.population = 20;
    config.founders = 40;
    config.generations = 40;
    config.mutation.add_neuron_probability = config.mutation.delete_edge_probability = 0.9;
    std::array<bool, 2> useless{};
    for (bool const prunes : {false, true}) {
        config.prune = prunes;
        evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
            for (Individual const& child : report.born)
                useless[prunes] |= compile(child.birth->genome).hidden_count < child.birth->genome.hidden_count();
            return true;
        });
    }
    EXPECT_TRUE(useless[0]);
    EXPECT_FALSE(useless[1]);
}

TEST(Evolve, gives_founders_and_children_the_interface_of_the_configuration) {
    SyntheticEvaluator evaluator;
    EvolutionConfig config = small_config();
    config.interface = {5, 2};
    config.generations = 4;
    evolve(config, 1, evaluator, {}, [&](GenerationReport const& report) {
        for (Individual const& child : report.born) {
            EXPECT_EQ(child.birth->genome.interface, config.interface);
            EXPECT_EQ(why_invalid(child.birth->genome), "");
        }
        return true;
    });
}

TEST(EvolutionState, signs_whole_rewards_as_integers_and_others_by_their_bits) {
    /// All are equal, with this reward.
    class Rewards : public ConstantEvaluator {
    public:
        explicit Rewards(double reward) : reward_(reward) {}
        std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes,
                                         CompletionListener* listener) override {
            auto evaluations = ConstantEvaluator::evaluate(genomes, listener);
            for (Evaluation& evaluation : evaluations) evaluation.reward = reward_;
            return evaluations;
        }

    private:
        double reward_;
    };
    struct Case {
        double reward;
        std::uint64_t word;
    };
    for (auto const& [reward, word] : {Case{3, 3}, Case{0, 0}, Case{-0.0, 0}, Case{-2, ~std::uint64_t{1}},
                                       Case{0.5, 0x3fe0000000000000u}, Case{0x1p63, 0x43e0000000000000u}}) {
        Rewards evaluator{reward};
        EvolutionConfig config = small_config();
        config.generations = 0;
        EvolutionState const state = evolve(config, 1, evaluator, {}, {});
        Signature expected;
        for (Individual const& member : state.population.members) {
            expected.add(std::uint64_t{member.id().slot});
            expected.add(word);
            for (int k = 0; k < member.objectives.count; ++k) expected.add(member.objectives.value[k]);
        }
        EXPECT_EQ(state.signature.value(), expected.value()) << reward;
    }
}
