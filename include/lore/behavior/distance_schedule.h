#pragma once

#include <lore/behavior/distances.h>

#include <cstdint>
#include <vector>

namespace lore {

/// Dynamic behavioral diversity (paper, same section): the distance changes every `period` generations.
struct DistanceSchedule {
    int period = 50;   ///< p_g [generations]
    std::vector<DistanceKind> distances{DistanceKind::adhoc, DistanceKind::hamming, DistanceKind::trajectory,
                                        DistanceKind::entropy};
};

/// The distance that serves a generation: draw number floor(generation / period), uniform, repeats allowed.
DistanceKind distance_at(std::uint64_t seed, int generation, DistanceSchedule const&);

/// Whether the shaping value, as one more that is drawn from, serves the generation's period instead of its distance:
/// with probability 1 / (distances + 1).
bool shaping_serves_at(std::uint64_t seed, int generation, DistanceSchedule const&);

}   // namespace lore
