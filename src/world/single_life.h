#pragma once

#include <lore/world/world.h>

#include <memory>
#include <utility>

namespace lore {

/// A batch of one as a Life, for worlds that know batches only.
class SingleLife final : public Life {
public:
    explicit SingleLife(std::unique_ptr<Lives> lives) : lives_(std::move(lives)) {}

    Position sense(std::span<float> sensors) const override {
        Position at;
        lives_->sense(sensors, {&at.x, 1}, {&at.y, 1});
        return at;
    }
    StepResult act(std::span<float const> effectors) override {
        StepResult result;
        unsigned char over = 0;
        lives_->act(effectors, {&result.reward, 1}, {&over, 1});
        result.over = over != 0;
        return result;
    }
    void outcome(std::span<float> values) const override { lives_->outcome(values); }

private:
    std::unique_ptr<Lives> lives_;
};

}   // namespace lore
