#pragma once

#include "farm_state.h"

#include <lore/archive/messages.h>
#include <lore/behavior/distance_measurer.h>

namespace lore {

/// Measures on all ranks (Farm::distances): each is given the pool and a range of rows, rank 0 too, of about equal
/// area. Shared are kinds whose pairs take longer than to send what they compare, where there are rows enough.
class DistanceFarm : public DistanceMeasurer {
public:
    explicit DistanceFarm(FarmState& state) : state_(state) {}

    void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&) override;

private:
    FarmState& state_;
    int pools_ = 0;   ///< shared so far: the number of the last one
};

/// A worker's part.
class DistanceWorker {
public:
    DistanceWorker(Post& post, int rank, int ranks) : post_(post), rank_(rank), ranks_(ranks) {}

    /// Hands the pool on to other ranks and keeps it until the next one comes.
    void take_pool(Message const&);
    /// Measures the rows of one message, waiting for their pool if another rank has not handed it on yet, and sends
    /// them back.
    void measure(Message const&);

private:
    Post& post_;
    int rank_, ranks_;
    int number_ = 0;   ///< of the pool; 0: none has come
    ComparedPool pool_;
    DistanceMatrix matrix_;   ///< kept from call to call
};

}   // namespace lore
