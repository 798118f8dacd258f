#pragma once

#include <lore/behavior/diversity.h>
#include <lore/core/signature.h>
#include <lore/evolution/selection.h>
#include <lore/network/mutation.h>

#include <functional>

namespace lore {

/// NSGA-II's settings. Objectives, in this order: balls, then BD and RS where they are used.
struct EvolutionConfig {
    int population = 200;     ///< survivors of a generation, and children of one. Paper: 200.
    int founders = 400;       ///< random individuals of generation 0, at least `population`
    int generations = 4000;   ///< Paper: 4000.
    TieRule ties = TieRule::random;
    bool use_diversity = true;   ///< objective BD; measured and reported in any case
    bool use_shaping = false;    ///< objective RS; set where a knowledge base is given
    DiversityConfig diversity;
    MutationConfig mutation;
    NetworkLimits limits;
};

/// Where evolution stands: all that a checkpoint must keep.
struct EvolutionState {
    Population population;
    Signature signature;   ///< over every generation's survivors, in order: id, balls, objectives
};

struct GenerationReport {
    int generation = 0;
    DistanceKind distance = DistanceKind::adhoc;
    int fronts = 0;
    std::span<Individual const> born;        ///< everybody evaluated in this generation
    EvolutionState const* state = nullptr;   ///< after selection
    double selection_seconds = 0;   ///< spent on breeding, ranking and choosing; the evaluator knows its own times
};

/// Called after each generation, the founders' (0) included; returns whether to go on.
using GenerationObserver = std::function<bool(GenerationReport const&)>;

/// The paper's method (NSGA-II with dynamic behavioral diversity) from `state`, or from the founders where it is
/// empty, to config.generations or until the observer says stop. A pure function of config, seed and evaluator.
EvolutionState evolve(EvolutionConfig const&, std::uint64_t seed, Evaluator&, EvolutionState state,
                      GenerationObserver const&);

/// Most balls in the population; ties: the earliest born, then the lowest slot.
Individual const& best_of_run(Population const&);

}   // namespace lore
