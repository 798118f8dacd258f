#include <lore/behavior/distance_schedule.h>

#include <lore/core/random.h>

#include <cassert>

namespace lore {

DistanceKind distance_at(std::uint64_t seed, int generation, DistanceSchedule const& schedule) {
    assert(schedule.period > 0 && !schedule.distances.empty());
    Stream rng{seed, Purpose::distance, static_cast<std::uint32_t>(generation / schedule.period)};
    return schedule.distances[rng.below(static_cast<std::uint32_t>(schedule.distances.size()))];
}

bool shaping_serves_at(std::uint64_t seed, int generation, DistanceSchedule const& schedule) {
    Stream rng{seed, Purpose::shaping_turn, static_cast<std::uint32_t>(generation / schedule.period)};
    return rng.below(static_cast<std::uint32_t>(schedule.distances.size()) + 1) == 0;
}

}   // namespace lore
