#include <lore/evolution/evolution.h>

#include "pool_distances.h"

#include <lore/core/stopwatch.h>
#include <lore/network/network.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace lore {

namespace {

/// The newly born, still to be filled in; once judged, they are only seen as Birth const.
using Newborns = std::vector<std::shared_ptr<Birth>>;

std::uint32_t word(int number) { return static_cast<std::uint32_t>(number); }

Newborns founders(std::vector<Genome> genomes) {
    Newborns born;
    for (Genome& genome : genomes) {
        auto birth = std::make_shared<Birth>();
        birth->id = {0, word(static_cast<int>(born.size()))};
        birth->genome = std::move(genome);
        born.push_back(std::move(birth));
    }
    return born;
}

/// One mutated copy of each tournament's winner; no crossover.
Newborns breed(Population const& parents, EvolutionConfig const& config, std::uint64_t seed, int generation) {
    Newborns born;
    for (int const winner : tournament_winners(parents.members, config.population, seed, generation)) {
        auto birth = std::make_shared<Birth>();
        birth->id = {word(generation), word(static_cast<int>(born.size()))};
        birth->parent = parents.members[winner].birth;
        birth->genome = birth->parent->genome;
        Stream rng{seed, Purpose::mutation, birth->id.generation, birth->id.slot};
        mutate(birth->genome, config.mutation, config.limits, rng);
        born.push_back(std::move(birth));
    }
    return born;
}

bool by_share(EvolutionConfig const& config) { return config.use_shaping && config.shaping.rule == ShapingRule::share; }

std::vector<Individual> evaluate(Newborns const& born, Evaluator& evaluator, CompletionListener& listener,
                                 bool by_share) {
    std::vector<Genome const*> genomes;
    for (auto const& birth : born) genomes.push_back(&birth->genome);
    std::vector<Evaluation> evaluations = evaluator.evaluate(genomes, &listener);
    assert(evaluations.size() == born.size());
    std::vector<Individual> individuals;
    for (std::size_t k = 0; k < born.size(); ++k) {
        born[k]->reward = evaluations[k].reward;
        born[k]->shaping = evaluations[k].shaping;
        Individual individual;
        individual.birth = born[k];
        individual.descriptors = std::make_shared<Descriptors const>(std::move(evaluations[k].descriptors));
        if (by_share)
            individual.shown = std::make_shared<std::vector<std::uint32_t> const>(std::move(evaluations[k].shown));
        individuals.push_back(std::move(individual));
    }
    return individuals;
}

Population join(Population parents, std::vector<Individual> children) {
    parents.members.insert(parents.members.end(), std::make_move_iterator(children.begin()),
                           std::make_move_iterator(children.end()));
    return parents;
}

/// Sets the diversity of every member within the pool.
void set_diversity(Population& pool, DistanceKind kind, PoolDistances::Measured distances) {
    pool.distances = std::move(distances.matrix);
    pool.distance_kind = kind;
    for (std::size_t i = 0; i < pool.members.size(); ++i) pool.members[i].diversity = distances.means[i];
}

/// RS of every member within the pool; only rule share looks at the others.
void set_shaping(Population& pool, EvolutionConfig const& config) {
    if (!by_share(config)) {
        for (Individual& member : pool.members) member.shaping = member.birth->shaping;
        return;
    }
    std::vector<double> const shaping = shares(pool.members, config.feature_values);
    for (std::size_t i = 0; i < pool.members.size(); ++i) pool.members[i].shaping = shaping[i];
}

Objectives objectives_of(Individual const& individual, EvolutionConfig const& config, bool shaping_serves) {
    Objectives objectives;
    auto const add = [&](double value) {
        assert(std::isfinite(value));
        objectives.value[objectives.count++] = value;
    };
    add(individual.birth->reward);
    if (shaping_serves) add(individual.shaping);
    else if (config.use_diversity) add(individual.diversity);
    if (config.use_shaping && config.shaping.use == ShapingUse::objective) add(individual.shaping);
    return objectives;
}

/// The order among equals as keys, the smaller first.
std::vector<std::uint64_t> tie_keys_of(Population const& pool, EvolutionConfig const& config, std::uint64_t seed) {
    std::vector<std::uint64_t> keys;
    for (Individual const& member : pool.members)
        keys.push_back(tie_key(config.ties, seed, pool.generation, member.id()));
    if (!config.use_shaping || config.shaping.use != ShapingUse::ties) return keys;
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        double const a_shaping = pool.members[a].shaping, b_shaping = pool.members[b].shaping;
        return a_shaping != b_shaping ? a_shaping > b_shaping : keys[a] < keys[b];
    });
    for (std::size_t place = 0; place < order.size(); ++place) keys[order[place]] = place;
    return keys;
}

/// The joint ranking of parents and children; leaves crowding distances in the pool.
Ranking rank(Population& pool, EvolutionConfig const& config, std::uint64_t seed, bool shaping_serves) {
    std::vector<Objectives> objectives;
    std::vector<std::uint64_t> const tie_keys = tie_keys_of(pool, config, seed);
    for (Individual& member : pool.members) {
        member.objectives = objectives_of(member, config, shaping_serves);
        objectives.push_back(member.objectives);
    }
    int const room = std::min(config.population, static_cast<int>(pool.members.size()));
    Ranking ranking =
        rank(objectives, tie_keys, room, {config.fronts, config.ends_among_equals, config.ties == TieRule::insertion});
    for (std::size_t i = 0; i < pool.members.size(); ++i) pool.members[i].crowding = ranking.crowding[i];
    return ranking;
}

Population survivors(Population const& pool, std::vector<int> const& chosen) {
    Population next;
    next.generation = pool.generation;
    next.distance_kind = pool.distance_kind;
    if (pool.distances.size() > 0) next.distances = pool.distances.select(chosen);
    for (int const i : chosen) next.members.push_back(pool.members[i]);
    return next;
}

/// As EvolutionState::signature says.
std::uint64_t signed_word(double reward) {
    constexpr double beyond = 0x1p63;
    bool const whole = std::trunc(reward) == reward && std::abs(reward) < beyond;
    return whole ? static_cast<std::uint64_t>(static_cast<std::int64_t>(reward)) : std::bit_cast<std::uint64_t>(reward);
}

void sign(Signature& signature, Population const& population) {
    for (Individual const& member : population.members) {
        signature.add((static_cast<std::uint64_t>(member.id().generation) << 32) | member.id().slot);
        signature.add(signed_word(member.birth->reward));
        for (int k = 0; k < member.objectives.count; ++k) signature.add(member.objectives.value[k]);
    }
}

}   // namespace

int inherited_founders(EvolutionConfig const& config) {
    return static_cast<int>(config.founding.share * config.founders + 0.5);
}

std::vector<Genome> founder_genomes(EvolutionConfig const& config, std::uint64_t seed, std::span<Genome const> origin) {
    int const inherited = origin.empty() ? 0 : inherited_founders(config);
    std::vector<Genome> genomes;
    for (int slot = 0; slot < config.founders; ++slot) {
        if (slot >= inherited) {
            genomes.push_back(founder(config.interface, Stream{seed, Purpose::founder, 0, word(slot)}));
            continue;
        }
        genomes.push_back(origin[static_cast<std::size_t>(slot) % origin.size()]);
        if (!config.founding.mutate) continue;
        Stream rng{seed, Purpose::founder_mutation, 0, word(slot)};
        mutate(genomes.back(), config.mutation, config.limits, rng);
    }
    return genomes;
}

EvolutionState evolve(EvolutionConfig const& config, std::uint64_t seed, Evaluator& evaluator,
                      DistanceMeasurer& measurer, EvolutionState state, GenerationObserver const& observer,
                      std::span<Genome const> origin) {
    int const first = state.population.members.empty() ? 0 : state.population.generation + 1;
    DistanceMatrix spare;   // the last pool's
    for (int generation = first; generation <= config.generations; ++generation) {
        Stopwatch watch;

        Newborns const born = generation == 0 ? founders(founder_genomes(config, seed, origin))
                                              : breed(state.population, config, seed, generation);
        if (config.prune)
            for (std::shared_ptr<Birth> const& birth : born) prune(birth->genome);
        double selection_seconds = watch.lap();

        bool const takes_turns = config.use_shaping && config.shaping.use == ShapingUse::distance;
        bool const shaping_serves = takes_turns && shaping_serves_at(seed, generation, config.distance_schedule);
        DistanceKind const kind = distance_at(seed, generation, config.distance_schedule);
        PoolDistances distances{state.population, static_cast<int>(born.size()), kind, std::move(spare)};
        std::vector<Individual> children = evaluate(born, evaluator, distances, by_share(config));

        Population pool = join(std::move(state.population), std::move(children));
        pool.generation = generation;
        set_diversity(pool, kind, std::move(distances).finish(pool, measurer));
        set_shaping(pool, config);
        auto const judged = std::span<Individual const>{pool.members}.last(born.size());
        for (std::size_t k = 0; k < born.size(); ++k) {
            born[k]->diversity = judged[k].diversity;
            born[k]->shaping = judged[k].shaping;
        }
        watch.lap();   // evaluating and measuring, which the farm accounts for

        Ranking const ranking = rank(pool, config, seed, shaping_serves);
        state.population = survivors(pool, ranking.survivors);
        spare = std::move(pool.distances);
        sign(state.signature, state.population);
        selection_seconds += watch.lap();

        if (observer &&
            !observer({generation, kind, shaping_serves, ranking.fronts, judged, &state, selection_seconds}))
            break;
    }
    return state;
}

EvolutionState evolve(EvolutionConfig const& config, std::uint64_t seed, Evaluator& evaluator, EvolutionState state,
                      GenerationObserver const& observer, std::span<Genome const> origin) {
    SerialMeasurer measurer;
    return evolve(config, seed, evaluator, measurer, std::move(state), observer, origin);
}

Individual const& best_of_run(Population const& population) {
    assert(!population.members.empty());
    return *std::min_element(population.members.begin(), population.members.end(),
                             [](Individual const& a, Individual const& b) {
                                 if (a.birth->reward != b.birth->reward) return a.birth->reward > b.birth->reward;
                                 return a.id() < b.id();
                             });
}

}   // namespace lore
