#include "foreign_world.h"

#include "foreign_call.h"
#include "refusal.h"
#include "single_life.h"

#include <lore/core/error.h>
#include <lore/world/values.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace lore {

namespace {

/// An array that a library writes: values that it leaves out, and those that it writes behind the end, show.
template <class T>
class WrittenArray {
public:
    WrittenArray(std::size_t size, T unwritten, T guard)
        : size_(size), unwritten_(unwritten), guard_(guard), values_(size + guards, guard) {}

    T* prepare() {
        std::fill_n(values_.begin(), size_, unwritten_);
        return values_.data();
    }
    bool overrun() const {
        return std::any_of(values_.begin() + static_cast<std::ptrdiff_t>(size_), values_.end(),
                           [&](T value) { return value != guard_; });
    }
    std::span<T const> view() const { return {values_.data(), size_}; }

private:
    static constexpr std::size_t guards = 4;

    std::size_t size_;
    T unwritten_, guard_;
    std::vector<T> values_;
};

using WrittenFloats = WrittenArray<float>;
WrittenFloats floats(std::size_t size) { return {size, std::numeric_limits<float>::quiet_NaN(), -7777.75f}; }

class ForeignLives final : public Lives {
public:
    ForeignLives(ForeignWorld const& world, int count)
        : world_(world), calls_(world.calls()), count_(static_cast<std::size_t>(count)),
          sensors_(floats(world.facts().sensors.size() * count_)), x_(floats(count_)), y_(floats(count_)),
          rewards_(floats(count_)), outcomes_(floats(static_cast<std::size_t>(world.facts().outcome_size) * count_)),
          over_(count_, 255, 77), before_(count_, 0) {
        ForeignCall const call{world_.called().c_str(), "begin"};
        lives_ = calls_.begin(world_.get(), count);
        if (lives_ == nullptr)
            throw Error(fmt::format("{} cannot begin {} lives", world_.called(), count), "its function begin gave NULL",
                        "Free some memory, or mend it.");
    }
    ForeignLives(ForeignLives const&) = delete;
    ForeignLives& operator=(ForeignLives const&) = delete;
    ~ForeignLives() override {
        ForeignCall const call{world_.called().c_str(), "end"};
        calls_.end(lives_);
    }

    int count() const override { return static_cast<int>(count_); }

    void sense(std::span<float> sensors, std::span<float> x, std::span<float> y) const override {
        {
            ForeignCall const call{world_.called().c_str(), "sense"};
            calls_.sense(lives_, sensors_.prepare(), x_.prepare(), y_.prepare());
        }
        refuse_overrun(sensors_, "sensors");
        refuse_overrun(x_, "x");
        refuse_overrun(y_, "y");
        refuse(why_senses_are_wrong(world_.facts(), sensors_.view(), x_.view(), y_.view()));
        std::ranges::copy(sensors_.view(), sensors.begin());
        std::ranges::copy(x_.view(), x.begin());
        std::ranges::copy(y_.view(), y.begin());
    }

    void act(std::span<float const> effectors, std::span<float> rewards, std::span<unsigned char> over) override {
        assert(effectors.size() == world_.facts().effectors.size() * count_);
        {
            ForeignCall const call{world_.called().c_str(), "act"};
            calls_.act(lives_, effectors.data(), rewards_.prepare(), over_.prepare());
        }
        refuse_overrun(rewards_, "reward");
        refuse_overrun(over_, "over");
        refuse(why_results_are_wrong(rewards_.view(), over_.view(), before_));
        ++steps_;
        std::ranges::copy(rewards_.view(), rewards.begin());
        std::ranges::copy(over_.view(), over.begin());
        std::ranges::copy(over_.view(), before_.begin());
    }

    void outcome(std::span<float> values) const override {
        {
            ForeignCall const call{world_.called().c_str(), "outcome"};
            calls_.outcome(lives_, outcomes_.prepare());
        }
        refuse_overrun(outcomes_, "outcome");
        refuse(why_outcomes_are_wrong(world_.facts(), outcomes_.view(), count()));
        std::ranges::copy(outcomes_.view(), values.begin());
    }

private:
    void refuse(std::string const& why) const { refuse_values(world_.called(), steps_, why); }
    template <class T>
    void refuse_overrun(WrittenArray<T> const& array, std::string_view name) const {
        if (array.overrun()) refuse(fmt::format("it wrote behind the end of the array '{}'", name));
    }

    ForeignWorld const& world_;
    lore_world_v1 const& calls_;
    std::size_t count_;
    void* lives_ = nullptr;
    std::int64_t steps_ = 0;   ///< done
    mutable WrittenFloats sensors_, x_, y_, rewards_, outcomes_;
    mutable WrittenArray<unsigned char> over_;
    std::vector<unsigned char> before_;
};

}   // namespace

ForeignWorld::~ForeignWorld() {
    if (world_ == nullptr) return;
    ForeignCall const call{called_.c_str(), "close"};
    calls().close(world_);
}

std::unique_ptr<Life> ForeignWorld::begin() const { return std::make_unique<SingleLife>(begin_lives(1)); }

std::unique_ptr<Lives> ForeignWorld::begin_lives(int count) const {
    assert(count >= 1 && count <= facts_.max_batch);
    return std::make_unique<ForeignLives>(*this, count);
}

}   // namespace lore
