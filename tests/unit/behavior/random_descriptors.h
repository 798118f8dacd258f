#pragma once

#include <lore/behavior/descriptors.h>
#include <lore/core/random.h>

#include <concepts>
#include <vector>

namespace lore {

/// Fills the fields of Descriptors by what they hold.
class RandomField {
public:
    RandomField(Stream& rng, int steps, int balls) : rng_(rng), steps_(steps), balls_(balls) {}

    void operator()(std::vector<Point>& points) const {
        for (int i = 0; i < balls_; ++i)
            points.push_back({static_cast<float>(rng_.uniform(0, 600)), static_cast<float>(rng_.uniform(0, 400))});
    }
    /// Bits that rarely change.
    void operator()(std::vector<std::uint16_t>& words) const {
        std::uint16_t word = static_cast<std::uint16_t>(rng_.below(1u << channel_count));
        for (int step = 0; step < steps_; ++step) {
            if (rng_.chance(0.05)) word ^= static_cast<std::uint16_t>(1u << rng_.below(channel_count));
            words.push_back(word);
        }
    }
    /// Lingers in a tile and then goes to a neighboring one, of twelve by eight.
    void operator()(std::vector<Tile>& path) const {
        Tile tile{static_cast<std::uint8_t>(rng_.below(12)), static_cast<std::uint8_t>(rng_.below(8))};
        for (int step = 0; step < steps_; step += steps_per_tile_sample) {
            if (rng_.chance(0.5)) {
                bool const across = rng_.coin();
                move(across ? tile.x : tile.y, across ? 11 : 7);
            }
            path.push_back(tile);
        }
    }
    template <std::floating_point Number, std::size_t size>
    void operator()(std::array<Number, size>& numbers) const {
        for (Number& number : numbers) number = static_cast<Number>(rng_.uniform());
    }
    void operator()(std::int32_t& count) const { count = static_cast<std::int32_t>(rng_.below(1000)); }

private:
    void move(std::uint8_t& place, int last) const {
        if (place == 0) ++place;
        else if (place == last || rng_.coin()) --place;
        else ++place;
    }

    Stream& rng_;
    int steps_, balls_;
};

inline Descriptors random_behavior(Stream& rng, int steps, int balls = 8) {
    Descriptors d;
    for_each_field(d, RandomField{rng, steps, balls});
    return d;
}

}   // namespace lore
