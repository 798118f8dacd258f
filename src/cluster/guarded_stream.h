#pragma once

#include <lore/cluster/farm.h>

#include <optional>
#include <string>

namespace lore {

/// What tests ask for, on top of an evaluation: LORE_TEST_DELAY=MS delays every genome by up to so many milliseconds,
/// and LORE_TEST_FAIL=RANK:N[:memory] lets that rank's Nth genome throw, now and whenever it is tried again; with
/// :reply the rank's evaluations from then on are ones that no rank can take.
StreamEvaluation with_test_hooks(StreamEvaluation, int rank);

/// A genome whose evaluation throws, and what it says.
struct Culprit {
    int ticket = 0;
    Genome genome;
    std::string reason;
};
/// Evaluates a stream; on an exception finds out whose it is, by trying those that were under way one after the other.
std::optional<Culprit> evaluate_guarded(StreamEvaluation const&, EvaluationFeed&);

}   // namespace lore
