#pragma once

#include <lore/evolution/evolution.h>

#include <memory>
#include <string>

namespace lore {

/// A population as a run has it after its first steps, so that benchmarks see behaviors that are as alike, and
/// objectives as tied, as in earnest. Evolved once per program.
struct EvolvedState {
    EvaluationContext context;
    EvolutionConfig config;
    EvolutionState state;
    std::vector<Individual> pool;   ///< the last joint pool: its parents, then its children

    std::vector<Descriptors const*> descriptors() const;
};

/// The built-in arena with this task.
std::shared_ptr<World const> collectball(std::string const& task);

/// From the founders of that seed.
EvolvedState evolve_for(int generations, std::uint64_t seed, EvaluationContext, EvolutionConfig = {});

/// Source task, 100 generations.
EvolvedState const& evolved_state();
/// Target task, 50 generations shaped by the learned base (learned_base.h).
EvolvedState const& evolved_with_knowledge();

}   // namespace lore
