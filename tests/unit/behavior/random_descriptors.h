#pragma once

#include <lore/behavior/descriptors.h>
#include <lore/core/random.h>

#include <cstdint>
#include <vector>

namespace lore {

/// Fills the fields of Descriptors by what they hold.
class RandomField {
public:
    RandomField(Stream& rng, int steps, int outcome_size, int channels)
        : rng_(rng), steps_(steps), outcome_size_(outcome_size), channels_(channels) {}

    void operator()(std::vector<float>& outcome) const {
        for (int i = 0; i < outcome_size_; ++i) outcome.push_back(static_cast<float>(rng_.uniform(0, 600)));
    }
    /// Bits that rarely change.
    void operator()(std::vector<std::uint16_t>& words) const {
        std::vector<std::uint16_t> now(static_cast<std::size_t>(channels_ + 15) / 16);
        auto const flip = [&](std::uint32_t channel) {
            now[channel / 16] ^= static_cast<std::uint16_t>(1u << channel % 16);
        };
        for (std::uint32_t channel = 0; channel < static_cast<std::uint32_t>(channels_); ++channel)
            if (rng_.coin()) flip(channel);
        for (int step = 0; step < steps_; ++step) {
            if (rng_.chance(0.05)) flip(rng_.below(static_cast<std::uint32_t>(channels_)));
            words.insert(words.end(), now.begin(), now.end());
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
    void operator()(std::vector<double>& entropies) const {
        for (int channel = 0; channel < channels_; ++channel) entropies.push_back(rng_.uniform());
    }
    void operator()(double& number) const {
        number = rng_.uniform();
    }   ///< of a field that a reader of extending.md adds

private:
    void move(std::uint8_t& place, int last) const {
        if (place == 0) ++place;
        else if (place == last || rng_.coin()) --place;
        else ++place;
    }

    Stream& rng_;
    int steps_, outcome_size_, channels_;
};

/// What the descriptors' sizes depend on besides the steps; those of the paper.
struct DescriptorSizes {
    int outcome_size = 16;
    int channels = 15;
};

inline Descriptors random_behavior(Stream& rng, int steps, DescriptorSizes const& sizes = {}) {
    Descriptors d;
    for_each_field(d, RandomField{rng, steps, sizes.outcome_size, sizes.channels});
    return d;
}

}   // namespace lore
