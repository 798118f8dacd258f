#pragma once

#include "farm_state.h"
#include "guarded_evaluation.h"

#include <lore/evaluation/evaluator.h>

namespace lore {

/// Evaluates on all ranks, rank 0 included (Farm::evaluator).
///
/// Rank 0 fills its own lanes genome by genome and sends the others sets that fill theirs, one set ahead; it looks for
/// their messages every few microseconds while its lanes run. A set takes the same time however few genomes it holds,
/// so workers get whole sets as long as possible, and rank 0, which has other duties, what is left.
class EvaluationFarm : public Evaluator {
public:
    EvaluationFarm(FarmState& state, EvaluationContext context)
        : state_(state), lanes_(std::move(context), state.communicator.rank()) {}

    std::vector<Evaluation> evaluate(std::span<Genome const* const>, CompletionListener* = nullptr) override;

private:
    std::vector<Evaluation> evaluate_everywhere(std::span<Genome const* const>, CompletionListener*);

    FarmState& state_;
    GuardedEvaluation lanes_;
};

}   // namespace lore
