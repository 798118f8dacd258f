#pragma once

#include <lore/behavior/distance_measurer.h>
#include <lore/evaluation/evaluator.h>
#include <lore/evolution/individual.h>

#include <vector>

namespace lore {

/// The mutual distances of parents and children: of small pools measured while the last children are still being
/// evaluated, of large ones afterwards. By Euclidean kinds only the means are found, afterwards.
///
/// Each child is measured against all that completed before it: the order of completion decides when a pair is
/// measured, and not its distance. Distances among parents are known from the last generation, unless the distance has
/// changed.
class PoolDistances : public CompletionListener {
public:
    /// `spare`: a matrix no longer needed, whose memory is taken.
    PoolDistances(Population const& parents, int children, DistanceKind, DistanceMatrix spare = {});

    /// Called at most once for each child.
    void completed(int child, Evaluation const&) override;
    void idle() override;
    struct Measured {
        std::vector<double> means;   ///< BD of each member
        DistanceMatrix matrix;       ///< empty by a Euclidean kind
    };
    /// Of the whole pool, in its order, parents first; the measurer measures what is missing.
    Measured finish(Population const& pool, DistanceMeasurer&) &&;

private:
    bool early() const;   ///< or all is left to finish()
    void measure_if_waiting(int least);

    DistanceKind kind_;
    int parents_;
    std::vector<int> order_;                  ///< members of the pool: parents, then children as they completed
    std::vector<Descriptors const*> shown_;   ///< by the members in `order_`
    int measured_;                            ///< the first so many of `order_` have been measured against each other
    DistanceMatrix matrix_;                   ///< in `order_`
};

}   // namespace lore
