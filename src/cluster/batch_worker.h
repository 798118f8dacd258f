#pragma once

#include <lore/cluster/farm.h>

#include <optional>

namespace lore {

/// The evaluation of one rank, with what tests ask for: LORE_TEST_DELAY=MS delays every batch by up to so many
/// milliseconds, and LORE_TEST_FAIL=RANK:N[:memory] lets a genome of that rank's Nth batch throw, now and always.
BatchEvaluation with_test_hooks(BatchEvaluation, int rank);

/// Which of a batch throws, and what it says; evaluates one after the other until one does. Without a culprit the first.
struct Culprit { std::size_t place = 0; std::string reason; };

/// Evaluates a batch; on an exception finds out whose it is.
struct BatchOutcome {
    std::vector<Evaluation> evaluations;
    std::optional<Culprit> culprit;
};
BatchOutcome evaluate_guarded(BatchEvaluation const&, std::span<Genome const* const>);

} // namespace lore
