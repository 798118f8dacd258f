#pragma once

#include <lore/behavior/distance_measurer.h>
#include <lore/behavior/distance_schedule.h>
#include <lore/core/signature.h>
#include <lore/evaluation/evaluator.h>
#include <lore/evolution/selection.h>
#include <lore/evolution/shaping.h>
#include <lore/network/mutation.h>

#include <functional>

namespace lore {

/// How generation 0 is made where genomes from elsewhere are given (the last population of another run, or clones of a
/// knowledge base).
struct FoundingConfig {
    double share = 1;     ///< Of the founders that come from there: round(share * founders), the first slots.
    bool mutate = true;   ///< One mutation each.
};

/// NSGA-II's settings. Objectives, in this order: reward, then BD and RS where they are used; in a period whose
/// distance is the shaping value (ShapingUse::distance), reward and RS.
struct EvolutionConfig {
    Interface interface;      ///< of the world's channels
    int population = 200;     ///< survivors of a generation, and children of one. Paper: 200.
    int founders = 400;       ///< random individuals of generation 0, at least `population`
    int generations = 4000;   ///< Paper: 4000.
    TieRule ties = TieRule::random;
    FrontsRule fronts = FrontsRule::dominance;   ///< of pools with two objectives
    bool ends_among_equals = false;              ///< crowding: also where a front is equal in an objective
    bool prune = false;                          ///< newborns lose the hidden neurons that reach no output
    bool use_diversity = true;                   ///< objective BD; measured and reported in any case
    bool use_shaping = false;                    ///< RS is used, as `shaping` says; set where a knowledge base is given
    ShapingConfig shaping;
    std::vector<double> feature_values;   ///< of the base; rule share alone needs them here
    DistanceSchedule distance_schedule;
    MutationConfig mutation;
    NetworkLimits limits;
    FoundingConfig founding;
};

/// Where evolution stands: all that a checkpoint must keep.
struct EvolutionState {
    Population population;
    /// Over every generation's survivors, in order: id, reward, objectives. A reward that is a whole number counts as
    /// that integer of 64 bits (a negative one as its two's complement), any other by the bits of the double.
    Signature signature;
};

struct GenerationReport {
    int generation = 0;
    DistanceKind distance = DistanceKind::adhoc;
    bool shaping_serves = false;   ///< RS stood in the place of BD (ShapingUse::distance)
    int fronts = 0;
    std::span<Individual const> born;        ///< all that were evaluated in this generation; valid during the call
    EvolutionState const* state = nullptr;   ///< after selection
    double selection_seconds = 0;            ///< breeding, ranking and choosing; the farm accounts for the rest [s]
};

/// Called after each generation, the founders' (0) included; false stops evolution.
using GenerationObserver = std::function<bool(GenerationReport const&)>;

/// The paper's method (NSGA-II with dynamic behavioral diversity) from `state`, or from the founders where it is
/// empty, to config.generations or until the observer says stop. A pure function of config, seed, state and origin:
/// evaluator and measurer decide where the work is done. Passes on what they throw; the state is lost then.
///
/// `origin` are the genomes that founders come from, as config.founding says; none: all founders are random.
/// Precondition: they are valid, of config.interface and within config.limits.
EvolutionState evolve(EvolutionConfig const&, std::uint64_t seed, Evaluator&, DistanceMeasurer&, EvolutionState state,
                      GenerationObserver const&, std::span<Genome const> origin = {});
/// The same with distances measured in this process.
EvolutionState evolve(EvolutionConfig const&, std::uint64_t seed, Evaluator&, EvolutionState state,
                      GenerationObserver const&, std::span<Genome const> origin = {});

/// How many founders come from elsewhere, if any do; the others are random.
int inherited_founders(EvolutionConfig const&);
/// Genomes of generation 0. Slot i of those that come from `origin` takes its genome i mod n, mutated once by the
/// stream (seed, founder_mutation, 0, i); the others are random: founder(), from the stream (seed, founder, 0, i).
std::vector<Genome> founder_genomes(EvolutionConfig const&, std::uint64_t seed, std::span<Genome const> origin);

/// Most reward in the population; ties: the earliest born, then the lowest slot. The population must not be empty.
Individual const& best_of_run(Population const&);

}   // namespace lore
