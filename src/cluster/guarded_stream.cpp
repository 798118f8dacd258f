#include "guarded_stream.h"

#include <lore/core/random.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <thread>

namespace lore {

namespace {

struct TestHooks {
    double longest_delay_ms = 0;
    long failing = -1;
    bool out_of_memory = false;
    bool damaged_reply = false;
};

TestHooks hooks_from_environment(int rank) {
    TestHooks hooks;
    if (char const* const delay = std::getenv("LORE_TEST_DELAY")) hooks.longest_delay_ms = std::atof(delay);
    if (char const* const fail = std::getenv("LORE_TEST_FAIL")) {
        char* rest = nullptr;
        if (std::strtol(fail, &rest, 10) == rank && *rest == ':') hooks.failing = std::strtol(rest + 1, &rest, 10);
        hooks.out_of_memory = std::strcmp(rest, ":memory") == 0;
        hooks.damaged_reply = std::strcmp(rest, ":reply") == 0;
    }
    return hooks;
}

/// What the hooks remember from stream to stream.
struct HookState {
    TestHooks hooks;
    Stream rng;
    long taken = 0;
    Genome victim;
};

class HookedFeed : public EvaluationFeed {
public:
    HookedFeed(EvaluationFeed& feed, HookState& state) : feed_(feed), state_(state) {}
    std::optional<Item> next() override {
        auto item = feed_.next();
        if (!item) return item;
        TestHooks const& hooks = state_.hooks;
        if (hooks.longest_delay_ms > 0)
            std::this_thread::sleep_for(
                std::chrono::duration<double, std::milli>(state_.rng.uniform() * hooks.longest_delay_ms));
        if (state_.taken++ == hooks.failing) state_.victim = *item->genome;
        if (!state_.victim.edges.empty() && *item->genome == state_.victim && !hooks.damaged_reply) {
            if (hooks.out_of_memory) throw std::bad_alloc{};
            throw std::runtime_error("a failure that the test asked for");
        }
        return item;
    }
    void deliver(int ticket, Evaluation evaluation) override {
        if (state_.hooks.damaged_reply && !state_.victim.edges.empty())
            evaluation.descriptors.balls.resize(most_balls + 1);
        feed_.deliver(ticket, std::move(evaluation));
    }
    void pulse() override { feed_.pulse(); }

private:
    EvaluationFeed& feed_;
    HookState& state_;
};

/// Remembers who is under way.
class WatchedFeed : public EvaluationFeed {
public:
    explicit WatchedFeed(EvaluationFeed& feed) : feed_(feed) {}
    std::optional<Item> next() override {
        auto const item = feed_.next();
        if (item) under_way.emplace(item->ticket, *item->genome);
        return item;
    }
    void deliver(int ticket, Evaluation evaluation) override {
        under_way.erase(ticket);
        feed_.deliver(ticket, std::move(evaluation));
    }
    void pulse() override { feed_.pulse(); }

    std::map<int, Genome> under_way;

private:
    EvaluationFeed& feed_;
};

class SingleFeed : public EvaluationFeed {
public:
    explicit SingleFeed(Genome const& genome) : genome_(&genome) {}
    std::optional<Item> next() override {
        if (genome_ == nullptr) return std::nullopt;
        return Item{0, std::exchange(genome_, nullptr)};
    }
    void deliver(int, Evaluation) override {}

private:
    Genome const* genome_;
};

std::string reason_of_current_exception() {
    try {
        throw;
    } catch (std::bad_alloc const&) { return "out of memory"; } catch (std::exception const& error) {
        return error.what();
    } catch (...) { return "an exception of unknown type"; }
}

}   // namespace

StreamEvaluation with_test_hooks(StreamEvaluation evaluate, int rank) {
    TestHooks const hooks = hooks_from_environment(rank);
    if (hooks.longest_delay_ms <= 0 && hooks.failing < 0) return evaluate;
    auto const state =
        std::make_shared<HookState>(HookState{hooks, Stream{static_cast<std::uint64_t>(rank), Purpose::test}, 0, {}});
    return [=](EvaluationFeed& feed) {
        HookedFeed hooked{feed, *state};
        evaluate(hooked);
    };
}

std::optional<Culprit> evaluate_guarded(StreamEvaluation const& evaluate, EvaluationFeed& feed) {
    WatchedFeed watched{feed};
    std::string reason;
    try {
        evaluate(watched);
        return std::nullopt;
    } catch (...) { reason = reason_of_current_exception(); }
    if (watched.under_way.empty()) throw Error("an evaluation failed", reason, "Resume the run.");
    for (auto const& [ticket, genome] : watched.under_way) {
        try {
            SingleFeed single{genome};
            evaluate(single);
        } catch (...) { return Culprit{ticket, genome, reason_of_current_exception()}; }
    }
    auto const& [ticket, genome] = *watched.under_way.begin();
    return Culprit{ticket, genome, reason + ", but none of those under way fails alone"};
}

}   // namespace lore
