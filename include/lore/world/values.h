#pragma once

#include <lore/world/facts.h>

#include <span>
#include <string>

namespace lore {

/// Checks of what a batch of lives gives, cheap where all is right: they say what is wrong with the first wrong value
/// ("sensor 'angle' of life 3 is 1.25, and sensors lie in [0, 1]"), or "". Arrays as in Lives.
std::string why_senses_are_wrong(WorldFacts const&, std::span<float const> sensors, std::span<float const> x,
                                 std::span<float const> y);
/// `before`: which lives were over before this step.
std::string why_results_are_wrong(std::span<float const> rewards, std::span<unsigned char const> over,
                                  std::span<unsigned char const> before);
std::string why_outcomes_are_wrong(WorldFacts const&, std::span<float const> values, int lives);

}   // namespace lore
