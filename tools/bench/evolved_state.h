#pragma once

#include <lore/evolution/evolution.h>

namespace lore {

/// A population as a run has it after its first steps, so that benchmarks see behaviours that are as alike, and
/// objectives as tied, as in earnest. Evolved once per program.
struct EvolvedState {
    EvaluationContext context;
    EvolutionConfig config;
    EvolutionState state;
    std::vector<Individual> pool;   ///< the last joint pool: its parents, then its children

    std::vector<Descriptors const*> descriptors() const;
};

EvolvedState const& evolved_state();

} // namespace lore
