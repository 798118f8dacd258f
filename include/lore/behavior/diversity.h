#pragma once

#include <lore/behavior/distances.h>

#include <cstdint>
#include <vector>

namespace lore {

/// Dynamic behavioral diversity (paper, same section): the distance changes every `period` generations.
struct DiversityConfig {
    int period = 50;   ///< p_g [generations]
    std::vector<DistanceKind> distances{DistanceKind::adhoc, DistanceKind::hamming, DistanceKind::trajectory,
                                        DistanceKind::entropy};
};

/// The distance that serves a generation: draw number floor(generation / period), uniform, repeats allowed.
DistanceKind distance_at(std::uint64_t seed, int generation, DiversityConfig const&);

}   // namespace lore
