#pragma once

#include <lore/evaluation/evaluator.h>
#include <lore/evolution/individual.h>

#include <vector>

namespace lore {

/// The mutual distances of parents and children, measured while the last children are still being evaluated.
///
/// Whoever arrives is held against all who came before, so the order of arrival decides who measures a pair, and not
/// what comes out. Distances among parents are known from the last generation, unless the distance itself has changed.
class PoolDistances : public Audience {
public:
    PoolDistances(Population const& parents, int children, DistanceKind);

    /// Each child arrives once, or never.
    void arrive(int child, Evaluation const&) override;
    void lull() override;
    /// The matrix of the whole pool, parents first, in its order; what is missing is left to the evaluator.
    DistanceMatrix finish(Population const& pool, Evaluator&) &&;

private:
    void measure_if_waiting(int least);

    DistanceKind kind_;
    int parents_;
    std::vector<int> order_;                  ///< members of the pool: parents, then children as they arrived
    std::vector<Descriptors const*> shown_;   ///< by those in `order_`
    int measured_;                            ///< so many of `order_` have been held against each other
    DistanceMatrix matrix_;                   ///< in `order_`
};

}   // namespace lore
