#include <lore/world/contract.h>

#include "life_script.h"
#include "memory_growth.h"

#include <lore/core/error.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>
#include <set>
#include <span>

#include <fmt/format.h>

namespace lore {

namespace {

using Records = std::vector<LifeRecord>;

/// A world under trial, what its lives showed the first time, and the report.
class Trial {
public:
    Trial(World const& world, std::function<std::unique_ptr<World>()> const& reopen, ContractConfig const& config)
        : world_(world), reopen_(reopen), batch_(std::min(config.lives, world.facts().max_batch)),
          script_(world.facts(), batch_, config.steps, config.seed), everybody_(static_cast<std::size_t>(batch_)) {
        std::iota(everybody_.begin(), everybody_.end(), 0);
    }

    ContractReport run() && {
        attempt("values", fmt::format("{} lives of up to {} steps", batch_, script_.steps()), [&] {
            reference_ = BatchRun{world_, script_, everybody_}.finish();
            return std::string{};
        });
        if (!report_.kept()) return std::move(report_);
        attempt("repeatable", "the same lives again", [&] { return compare(run_of(everybody_), everybody_, again); });
        attempt("senses", "sensors and outcomes asked for twice as often", [&] {
            return compare(BatchRun{world_, script_, everybody_, true}.finish(), everybody_,
                           "where sensors and outcomes are asked for more often");
        });
        attempt("places", "the lives in other places of the batch", [&] { return permuted(); });
        attempt("company", "each life alone, and in batches of 3", [&] { return small_batches(); });
        attempt("batches", "two batches and two worlds under way by turns", [&] { return by_turns(); });
        attempt("ends", "after lives that were ended early", [&] { return after_early_ends(); });
        attempt("memory", "", [&] { return memory(); });
        report_.sample = sample();
        return std::move(report_);
    }

private:
    static constexpr std::string_view again = "the second time";

    /// Runs a rule, which says what breaks it or "". Errors break it too.
    template <class Rule>
    void attempt(std::string name, std::string tried, Rule const& rule) {
        report_.rules.push_back({std::move(name), std::move(tried), true});
        std::string broken;
        try {
            broken = rule();
        } catch (Error const& error) { broken = error.what(); }
        if (broken.empty()) return;
        report_.rules.back().finding = std::move(broken);
        report_.rules.back().kept = false;
    }

    Records run_of(std::vector<int> const& who) const { return BatchRun{world_, script_, who}.finish(); }

    /// The first difference of `records`, which are of the lives `who`, from the reference.
    std::string compare(Records const& records, std::vector<int> const& who, std::string_view other) const {
        for (std::size_t i = 0; i < who.size(); ++i) {
            std::string const difference = first_difference(
                world_.facts(), reference_[static_cast<std::size_t>(who[i])], records[i], "the first time", other);
            if (!difference.empty()) return fmt::format("life {}: {}", who[i], difference);
        }
        return "";
    }

    std::string permuted() const {
        std::vector<int> backwards{everybody_.rbegin(), everybody_.rend()};
        if (std::string broken = compare(run_of(backwards), backwards, "in the batch turned round"); !broken.empty())
            return broken;
        std::vector<int> turned = everybody_;
        std::rotate(turned.begin(), turned.begin() + batch_ / 3, turned.end());
        return compare(run_of(turned), turned, "in the batch moved on");
    }

    std::string small_batches() const {
        for (int const life : everybody_)
            if (std::string broken = compare(run_of({life}), {life}, "alone (n = 1)"); !broken.empty()) return broken;
        std::vector<int> const three{everybody_.begin(), everybody_.begin() + std::min(3, batch_)};
        return compare(run_of(three), three, fmt::format("in a batch of {}", three.size()));
    }

    std::string by_turns() const {
        std::unique_ptr<World> const second = reopen_();
        if (second->facts() != world_.facts()) return "the world opened again has other facts";
        std::vector<int> const backwards{everybody_.rbegin(), everybody_.rend()};
        BatchRun first{world_, script_, everybody_}, other{world_, script_, backwards},
            elsewhere{*second, script_, everybody_};
        for (bool more = true; more;) {
            more = first.step();
            more |= other.step();
            more |= elsewhere.step();
        }
        if (std::string broken = compare(first.finish(), everybody_, "beside another batch"); !broken.empty())
            return broken;
        if (std::string broken = compare(other.finish(), backwards, "beside another batch"); !broken.empty())
            return broken;
        return compare(elsewhere.finish(), everybody_, "in the world opened again");
    }

    std::string after_early_ends() const {
        for (int batch = 0; batch < 8; ++batch) {
            BatchRun early{world_, script_, everybody_};
            for (int step = 0; step < batch; ++step) early.step();
        }
        return compare(run_of(everybody_), everybody_, "after others were ended early");
    }

    std::string memory() {
        MemoryGrowth const growth = memory_growth(world_, batch_);
        report_.rules.back().finding = growth.measured;
        return growth.what.empty() ? "" : fmt::format("memory grows {}, over {}", growth.what, growth.measured);
    }

    WorldSample sample() const {
        WorldSample sample;
        sample.lives = batch_;
        sample.least_return = sample.most_return = reference_.front().sum_of_rewards();
        for (LifeRecord const& life : reference_) {
            sample.ended += life.over;
            sample.least_return = std::min(sample.least_return, life.sum_of_rewards());
            sample.most_return = std::max(sample.most_return, life.sum_of_rewards());
            sample.effectors_matter |=
                !first_difference(world_.facts(), reference_.front(), life, "here", "there").empty();
        }
        for (std::size_t s = 0; s < world_.facts().sensors.size(); ++s)
            if (is_constant(s)) sample.constant_sensors.push_back(world_.facts().sensors[s].name);
        return sample;
    }

    bool is_constant(std::size_t sensor) const {
        std::size_t const count = world_.facts().sensors.size();
        for (LifeRecord const& life : reference_)
            for (std::size_t at = sensor; at < life.sensors.size(); at += count)
                if (life.sensors[at] != reference_.front().sensors[sensor]) return false;
        return true;
    }

    World const& world_;
    std::function<std::unique_ptr<World>()> const& reopen_;
    int batch_;
    LifeScript script_;
    std::vector<int> everybody_;
    Records reference_;
    ContractReport report_;
};

double now(Timekeeper timekeeper) {
    if (timekeeper == Timekeeper::processor) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}   // namespace

bool ContractReport::kept() const {
    return std::ranges::all_of(rules, [](RuleReport const& rule) { return rule.kept; });
}

ContractReport check_contract(World const& world, std::function<std::unique_ptr<World>()> const& reopen,
                              ContractConfig const& config) {
    return Trial{world, reopen, config}.run();
}

double measure_speed(World const& world, int lives, double seconds, Timekeeper timekeeper) {
    constexpr int steps = 1000;
    WorldFacts const& facts = world.facts();
    auto const n = static_cast<std::size_t>(lives);
    LifeScript const script{facts, lives, steps, 1};
    std::vector<float> effectors(facts.effectors.size() * n * steps);   // [step], each as act takes it
    for (std::size_t step = 0; step < steps; ++step)
        for (std::size_t c = 0; c < facts.effectors.size(); ++c)
            for (std::size_t i = 0; i < n; ++i)
                effectors[(step * facts.effectors.size() + c) * n + i] =
                    script.effector(static_cast<int>(i), static_cast<int>(step), static_cast<int>(c));
    std::vector<float> sensors(facts.sensors.size() * n), x(n), y(n), rewards(n);
    std::vector<unsigned char> over(n);
    double done = 0;
    double const start = now(timekeeper);
    auto const spent = [&] { return now(timekeeper) - start; };
    auto const in_time = [&](std::size_t step) { return step % 64 != 63 || spent() < seconds; };
    do {
        auto const batch = world.begin_lives(lives);
        std::ptrdiff_t living = lives;
        for (std::size_t step = 0; step < steps && living > 0 && in_time(step); ++step) {
            batch->sense(sensors, x, y);
            batch->act(std::span{effectors}.subspan(step * facts.effectors.size() * n, facts.effectors.size() * n),
                       rewards, over);
            done += static_cast<double>(living);
            living = std::ranges::count(over, 0);
        }
    } while (spent() < seconds);
    return done / spent();
}

}   // namespace lore
