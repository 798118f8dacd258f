#pragma once

#include "farm_state.h"

#include <lore/archive/messages.h>
#include <lore/behavior/distance_measurer.h>

namespace lore {

/// Measures on all ranks (Farm::distances): each is given the pool and a range of its members, rank 0 too, that take
/// about equally long. Where there are few, rank 0 measures alone.
class DistanceFarm : public DistanceMeasurer {
public:
    explicit DistanceFarm(FarmState& state) : state_(state) {}

    void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&) override;
    std::vector<double> means(DistanceKind, std::span<Descriptors const* const> pool) override;

private:
    FarmState& state_;
};

/// A worker's part.
class DistanceWorker {
public:
    DistanceWorker(Post& post, int rank, int ranks) : post_(post), rank_(rank), ranks_(ranks) {}

    /// Hands the pool of the message on, measures this rank's rows or means and sends them to rank 0.
    void measure(Message const&);

private:
    Post& post_;
    int rank_, ranks_;
    ComparedPool pool_;   ///< this and the matrix: kept for their memory
    DistanceMatrix matrix_;
};

}   // namespace lore
