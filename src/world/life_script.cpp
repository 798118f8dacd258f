#include "life_script.h"

#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/world/values.h>

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/format.h>

namespace lore {

namespace {

/// How long a life holds its effectors [steps], and what it draws: jitter stays near the start, holds get somewhere.
constexpr std::array holds{1, 10, 50};

float draw(Stream& rng, bool binary, bool extreme) {
    double const value = rng.uniform();
    if (binary || extreme) return value < 0.5 ? 0.0f : 1.0f;
    return static_cast<float>(value);
}

bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

}   // namespace

LifeScript::LifeScript(WorldFacts const& facts, int lives, int steps, std::uint64_t seed)
    : steps_(steps), channels_(facts.effectors.size()) {
    values_.reserve(static_cast<std::size_t>(lives) * static_cast<std::size_t>(steps) * channels_);
    std::vector<float> now(channels_);
    for (int life = 0; life < lives; ++life) {
        Stream rng{seed, Purpose::test, 0, static_cast<std::uint32_t>(life)};
        int const hold = life % 4 == 3 ? steps : holds[static_cast<std::size_t>(life % 4)];   // every fourth: constant
        bool const extreme = life % 8 >= 4;
        for (int step = 0; step < steps; ++step) {
            if (step % hold == 0)
                for (std::size_t c = 0; c < channels_; ++c) now[c] = draw(rng, facts.effectors[c].binary, extreme);
            values_.insert(values_.end(), now.begin(), now.end());
        }
    }
}

double LifeRecord::sum_of_rewards() const {
    double sum = 0;
    for (float const reward : rewards) sum += reward;
    return sum;
}

BatchRun::BatchRun(World const& world, LifeScript const& script, std::vector<int> who, bool curious)
    : facts_(world.facts()), script_(script), who_(std::move(who)), curious_(curious),
      lives_(world.begin_lives(static_cast<int>(who_.size()))), sensors_(facts_.sensors.size() * who_.size()),
      x_(who_.size()), y_(who_.size()), effectors_(facts_.effectors.size() * who_.size()), rewards_(who_.size()),
      outcomes_(static_cast<std::size_t>(facts_.outcome_size) * who_.size()), over_(who_.size()), before_(who_.size()),
      records_(who_.size()) {}

bool BatchRun::step() {
    bool const all_over = std::ranges::all_of(over_, [](unsigned char over) { return over != 0; });
    if (step_ == script_.steps() || all_over) return false;
    lives_->sense(sensors_, x_, y_);
    if (curious_) {
        lives_->outcome(outcomes_);
        lives_->sense(sensors_, x_, y_);
    }
    check(why_senses_are_wrong(facts_, sensors_, x_, y_));
    for (std::size_t c = 0; c < facts_.effectors.size(); ++c)
        for (std::size_t i = 0; i < who_.size(); ++i)
            effectors_[c * who_.size() + i] = script_.effector(who_[i], step_, static_cast<int>(c));
    before_ = over_;
    lives_->act(effectors_, rewards_, over_);
    check(why_results_are_wrong(rewards_, over_, before_));
    record();
    ++step_;
    return true;
}

void BatchRun::record() {
    for (std::size_t i = 0; i < who_.size(); ++i) {
        if (before_[i] != 0) continue;
        LifeRecord& life = records_[i];
        for (std::size_t s = 0; s < facts_.sensors.size(); ++s) life.sensors.push_back(sensors_[s * who_.size() + i]);
        life.positions.push_back({x_[i], y_[i]});
        life.rewards.push_back(rewards_[i]);
        life.over = over_[i] != 0;
    }
}

std::vector<LifeRecord> BatchRun::finish() {
    while (step()) {}
    lives_->outcome(outcomes_);
    check(why_outcomes_are_wrong(facts_, outcomes_, lives_->count()));
    for (std::size_t i = 0; i < who_.size(); ++i)
        for (std::size_t k = 0; k < static_cast<std::size_t>(facts_.outcome_size); ++k)
            records_[i].outcome.push_back(outcomes_[k * who_.size() + i]);
    lives_.reset();
    return std::move(records_);
}

void BatchRun::check(std::string const& why) const {
    if (!why.empty())
        throw Error(fmt::format("{} breaks its contract at step {}", title(facts_), step_), why, "Mend it.");
}

std::string first_difference(WorldFacts const& facts, LifeRecord const& a, LifeRecord const& b, std::string_view first,
                             std::string_view second) {
    auto const differ = [&](int step, std::string const& what, float one, float other) {
        // Nine digits tell any two floats apart.
        return fmt::format("at step {} {} is {:.9g} {} and {:.9g} {}", step, what, one, first, other, second);
    };
    std::size_t const sensors = facts.sensors.size();
    for (int step = 0; step < std::min(a.steps(), b.steps()); ++step) {
        auto const at = static_cast<std::size_t>(step);
        for (std::size_t s = 0; s < sensors; ++s)
            if (float const one = a.sensors[at * sensors + s], other = b.sensors[at * sensors + s]; !same(one, other))
                return differ(step, fmt::format("sensor '{}'", facts.sensors[s].name), one, other);
        if (!same(a.positions[at].x, b.positions[at].x)) return differ(step, "x", a.positions[at].x, b.positions[at].x);
        if (!same(a.positions[at].y, b.positions[at].y)) return differ(step, "y", a.positions[at].y, b.positions[at].y);
        if (!same(a.rewards[at], b.rewards[at])) return differ(step, "the reward", a.rewards[at], b.rewards[at]);
    }
    if (a.steps() != b.steps() || a.over != b.over)
        return fmt::format("the life has {} steps {}{} and {} steps {}{}", a.steps(), first,
                           a.over ? ", is over then" : "", b.steps(), second, b.over ? ", is over then" : "");
    for (std::size_t k = 0; k < a.outcome.size(); ++k)
        if (!same(a.outcome[k], b.outcome[k]))
            return differ(a.steps(), fmt::format("outcome {}", k), a.outcome[k], b.outcome[k]);
    return "";
}

}   // namespace lore
