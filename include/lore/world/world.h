#pragma once

#include <lore/world/facts.h>

#include <memory>
#include <span>
#include <string>

namespace lore {

/// Where a life is [u].
struct Position {
    float x = 0, y = 0;
    friend bool operator==(Position const&, Position const&) = default;
};

/// What a step gives.
struct StepResult {
    float reward = 0;    ///< of this step [the world's reward_unit]; finite, may be below 0
    bool over = false;   ///< the life has ended with this step
    friend bool operator==(StepResult const&, StepResult const&) = default;
};

/// One evaluation under way: the definition that every faster path must equal to the bit.
///
/// Per step: sense, then act by effectors in [0, 1] (0 or 1 for a binary one); act is not called once a life is over.
/// sense and outcome change nothing and may be called at any time. A function of the world and of the effectors alone:
/// it draws nothing at random. Spans have the sizes of the facts. One thread at a time. The World outlives its lives.
/// A world of foreign code may throw Error from any call (library.h); others throw nothing.
class Life {
public:
    virtual ~Life() = default;
    /// The values of the sensors, in [0, 1], and the position to which they belong: before the step's action.
    virtual Position sense(std::span<float> sensors) const = 0;
    virtual StepResult act(std::span<float const> effectors) = 0;
    /// How the life has ended, or would if it ended now.
    virtual void outcome(std::span<float> values) const = 0;
};

/// Lives of one world side by side, each equal to a Life to the bit, whatever their number and their order.
///
/// Arrays are [channel][count()], rewards, over and positions [count()]. A life that is over stays as it is: act may be
/// called while others go on, and gives reward 0 and over 1 for it. Otherwise as Life.
class Lives {
public:
    virtual ~Lives() = default;
    virtual int count() const = 0;
    virtual void sense(std::span<float> sensors, std::span<float> x, std::span<float> y) const = 0;
    virtual void act(std::span<float const> effectors, std::span<float> rewards, std::span<unsigned char> over) = 0;
    virtual void outcome(std::span<float> values) const = 0;
};

/// What controllers are evaluated in: one task with its constants, immutable.
class World {
public:
    virtual ~World() = default;
    /// Valid: why_invalid(facts()) is "".
    virtual WorldFacts const& facts() const = 0;
    /// A life at its start; all start alike.
    virtual std::unique_ptr<Life> begin() const = 0;
    /// `count` of them side by side, 1 to facts().max_batch. The plain way here steps one after the other.
    virtual std::unique_ptr<Lives> begin_lives(int count) const;
    /// What pictures show behind the paths: one SVG element in units of positions, y downwards; "" for none.
    virtual std::string scene_svg() const { return {}; }
};

}   // namespace lore
