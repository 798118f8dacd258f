#pragma once

#include <lore/behavior/descriptors.h>
#include <lore/core/random.h>

#include <vector>

namespace lore {

/// A behavior that moves like a robot: it lingers in a tile and then goes to a neighboring one; bits rarely change.
inline Descriptors random_behavior(Stream& rng, int steps, int balls = 8) {
    Descriptors d;
    for (int i = 0; i < balls; ++i)
        d.balls.push_back({static_cast<float>(rng.uniform(0, 600)), static_cast<float>(rng.uniform(0, 400))});
    std::uint16_t word = static_cast<std::uint16_t>(rng.below(1u << 15));
    for (int step = 0; step < steps; ++step) {
        if (rng.chance(0.05)) word ^= static_cast<std::uint16_t>(1u << rng.below(15));
        d.bits.push_back(word);
    }
    Tile tile{static_cast<std::uint8_t>(rng.below(12)), static_cast<std::uint8_t>(rng.below(8))};
    for (int step = 0; step < steps; step += steps_per_tile_sample) {
        if (rng.chance(0.5)) {
            if (rng.coin())
                tile.x = static_cast<std::uint8_t>(tile.x == 0    ? 1
                                                   : tile.x == 11 ? 10
                                                   : rng.coin()   ? tile.x - 1
                                                                  : tile.x + 1);
            else
                tile.y = static_cast<std::uint8_t>(tile.y == 0   ? 1
                                                   : tile.y == 7 ? 6
                                                   : rng.coin()  ? tile.y - 1
                                                                 : tile.y + 1);
        }
        d.path.push_back(tile);
    }
    for (double& entropy : d.entropies) entropy = rng.uniform();
    return d;
}

inline std::vector<Descriptors const*> pointers_to(std::vector<Descriptors> const& pool) {
    std::vector<Descriptors const*> pointers;
    for (Descriptors const& d : pool) pointers.push_back(&d);
    return pointers;
}

}   // namespace lore
