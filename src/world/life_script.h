#pragma once

#include <lore/world/contract.h>
#include <lore/world/world.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// The effectors of a number of lives, step by step.
class LifeScript {
public:
    LifeScript(WorldFacts const&, int lives, int steps, std::uint64_t seed);

    int steps() const { return steps_; }
    float effector(int life, int step, int channel) const {
        return values_[(static_cast<std::size_t>(life) * static_cast<std::size_t>(steps_) +
                        static_cast<std::size_t>(step)) *
                           channels_ +
                       static_cast<std::size_t>(channel)];
    }

private:
    int steps_;
    std::size_t channels_;
    std::vector<float> values_;   ///< [life][step][channel]
};

/// All that a life showed.
struct LifeRecord {
    std::vector<float> sensors;   ///< [step][sensor]
    std::vector<Position> positions;
    std::vector<float> rewards;
    std::vector<float> outcome;
    bool over = false;

    int steps() const { return static_cast<int>(rewards.size()); }
    double sum_of_rewards() const;
};

/// Lives `who` of a script side by side, step by step. Throws Error where a value is wrong.
class BatchRun {
public:
    /// `curious`: asks for sensors twice and for outcomes at every step, which must change nothing.
    BatchRun(World const&, LifeScript const&, std::vector<int> who, bool curious = false);
    /// False once all lives are over or have had their steps.
    bool step();
    /// The records, in the order of `who`, after the steps that are left.
    std::vector<LifeRecord> finish();

private:
    void record();
    void check(std::string const& why) const;

    WorldFacts const& facts_;
    LifeScript const& script_;
    std::vector<int> who_;
    bool curious_;
    std::unique_ptr<Lives> lives_;
    int step_ = 0;
    std::vector<float> sensors_, x_, y_, effectors_, rewards_, outcomes_;
    std::vector<unsigned char> over_, before_;
    std::vector<LifeRecord> records_;
};

/// What differs first between two records of one life: "at step 17 sensor 'angle' is 0.25 FIRST and 0.26 SECOND"; ""
/// where they are equal to the bit. `first` and `second` say which records they are: "the first time".
std::string first_difference(WorldFacts const&, LifeRecord const&, LifeRecord const&, std::string_view first,
                             std::string_view second);

}   // namespace lore
