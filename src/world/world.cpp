#include <lore/world/world.h>

#include <algorithm>
#include <cassert>
#include <vector>

namespace lore {

namespace {

/// The plain twin of every batch.
class LivesInTurn final : public Lives {
public:
    LivesInTurn(World const& world, int count)
        : facts_(world.facts()), over_(static_cast<std::size_t>(count)),
          channels_(std::max(
              {facts_.sensors.size(), facts_.effectors.size(), static_cast<std::size_t>(facts_.outcome_size)})) {
        for (int i = 0; i < count; ++i) lives_.push_back(world.begin());
    }

    int count() const override { return static_cast<int>(lives_.size()); }

    void sense(std::span<float> sensors, std::span<float> x, std::span<float> y) const override {
        for (std::size_t i = 0; i < lives_.size(); ++i) {
            Position const at = lives_[i]->sense(std::span{channels_}.first(facts_.sensors.size()));
            scatter(i, facts_.sensors.size(), sensors);
            x[i] = at.x;
            y[i] = at.y;
        }
    }

    void act(std::span<float const> effectors, std::span<float> rewards, std::span<unsigned char> over) override {
        for (std::size_t i = 0; i < lives_.size(); ++i) {
            StepResult result{0, true};
            if (over_[i] == 0) {
                for (std::size_t c = 0; c < facts_.effectors.size(); ++c)
                    channels_[c] = effectors[c * lives_.size() + i];
                result = lives_[i]->act(std::span{channels_}.first(facts_.effectors.size()));
            }
            rewards[i] = result.reward;
            over[i] = over_[i] = result.over;
        }
    }

    void outcome(std::span<float> values) const override {
        auto const size = static_cast<std::size_t>(facts_.outcome_size);
        for (std::size_t i = 0; i < lives_.size(); ++i) {
            lives_[i]->outcome(std::span{channels_}.first(size));
            scatter(i, size, values);
        }
    }

private:
    void scatter(std::size_t life, std::size_t channels, std::span<float> into) const {
        for (std::size_t c = 0; c < channels; ++c) into[c * lives_.size() + life] = channels_[c];
    }

    WorldFacts const& facts_;
    std::vector<std::unique_ptr<Life>> lives_;
    std::vector<unsigned char> over_;
    mutable std::vector<float> channels_;   ///< of one life
};

}   // namespace

std::unique_ptr<Lives> World::begin_lives(int count) const {
    assert(count >= 1 && count <= facts().max_batch);
    return std::make_unique<LivesInTurn>(*this, count);
}

}   // namespace lore
