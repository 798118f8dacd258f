#pragma once

#include "test_hooks.h"

#include <lore/evaluation/evaluation_queue.h>

#include <optional>
#include <string>

namespace lore {

/// A genome whose evaluation throws.
struct Culprit {
    int ticket = 0;
    Genome genome;
    std::string reason;
};

/// Evaluates in this rank's lanes, and finds out whose evaluation failed.
class GuardedEvaluation {
public:
    GuardedEvaluation(EvaluationContext context, int rank) : context_(std::move(context)), hooks_(rank) {}

    /// evaluate_queue. After an exception evaluates alone, one after the other, the genomes that were in the lanes, and
    /// returns the first that throws again, else the first of them. Throws Error if the lanes were empty, and what the
    /// queue throws.
    std::optional<Culprit> evaluate(EvaluationQueue&);

private:
    EvaluationContext context_;
    TestHooks hooks_;
};

}   // namespace lore
