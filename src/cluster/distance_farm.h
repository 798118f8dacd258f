#pragma once

#include "farm_state.h"

#include <lore/behavior/distance_measurer.h>

namespace lore {

/// Measures on all ranks (Farm::distances): ranges of rows of about equal area, one more than it works on held by each
/// worker, the rest taken by rank 0 and by the worker that is ready first. Only trajectory distances are shared; the
/// others take less time than it takes to send the descriptors.
class DistanceFarm : public DistanceMeasurer {
public:
    explicit DistanceFarm(FarmState& state) : state_(state) {}

    void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&) override;

private:
    FarmState& state_;
};

/// A worker's part: measures the rows of one message and sends them back. `scratch` is kept from call to call.
void measure_for_rank_0(Post&, Message const&, DistanceMatrix& scratch);

}   // namespace lore
