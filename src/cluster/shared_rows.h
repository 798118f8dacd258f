#pragma once

#include "post.h"

#include <lore/cluster/farm.h>

namespace lore {

/// Trajectory distances of rows [known, size) of a pool, measured by all ranks: ranges of about equal area, one more
/// than it works on held by each worker, the rest taken by rank 0 and by whoever is ready first.
void measure_together(Post&, int ranks, std::span<Descriptors const* const> pool, int known, DistanceMatrix&,
                      RankTimes&);

/// A worker's part: measures the rows of one message and sends them back. `scratch` is kept from call to call.
void measure_for_rank_0(Post&, Message const&, DistanceMatrix& scratch);

}   // namespace lore
