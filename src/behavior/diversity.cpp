#include <lore/behavior/diversity.h>

#include <lore/core/random.h>

#include <cassert>

namespace lore {

DistanceKind distance_at(std::uint64_t seed, int generation, DiversityConfig const& config) {
    assert(config.period > 0 && !config.distances.empty());
    Stream rng{seed, Purpose::distance, static_cast<std::uint32_t>(generation / config.period)};
    return config.distances[rng.below(static_cast<std::uint32_t>(config.distances.size()))];
}

bool shaping_serves_at(std::uint64_t seed, int generation, DiversityConfig const& config) {
    Stream rng{seed, Purpose::shaping_turn, static_cast<std::uint32_t>(generation / config.period)};
    return rng.below(static_cast<std::uint32_t>(config.distances.size()) + 1) == 0;
}

}   // namespace lore
