#include "test_hooks.h"

#ifdef LORE_TEST_HOOKS

#include <lore/core/random.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <thread>

namespace lore {

struct TestHooks::State {
    explicit State(int rank) : rng{static_cast<std::uint64_t>(rank), Purpose::test} {}

    double longest_delay_ms = 0;
    long failing = -1;   ///< number of the genome, in this rank's order
    bool out_of_memory = false;
    bool damaged_reply = false;

    Stream rng;
    long taken = 0;
    Genome victim;   ///< without edges until the failing one has been taken
    bool failed() const { return !victim.edges.empty(); }
};

TestHooks::TestHooks(int rank) {
    State asked{rank};
    if (char const* const delay = std::getenv("LORE_TEST_DELAY")) asked.longest_delay_ms = std::atof(delay);
    if (char const* const fail = std::getenv("LORE_TEST_FAIL")) {
        char* rest = nullptr;
        if (std::strtol(fail, &rest, 10) == rank && *rest == ':') asked.failing = std::strtol(rest + 1, &rest, 10);
        asked.out_of_memory = std::strcmp(rest, ":memory") == 0;
        asked.damaged_reply = std::strcmp(rest, ":reply") == 0;
    }
    if (asked.longest_delay_ms > 0 || asked.failing >= 0) state_ = std::make_unique<State>(std::move(asked));
}

TestHooks::~TestHooks() = default;

void TestHooks::before_evaluation(Genome const& genome) {
    if (!state_) return;
    State& state = *state_;
    if (state.longest_delay_ms > 0)
        std::this_thread::sleep_for(
            std::chrono::duration<double, std::milli>(state.rng.uniform() * state.longest_delay_ms));
    if (state.taken++ == state.failing) state.victim = genome;
    if (!state.failed() || state.damaged_reply || genome != state.victim) return;
    if (state.out_of_memory) throw std::bad_alloc{};
    throw std::runtime_error("a failure that the test asked for");
}

void TestHooks::before_delivery(Evaluation& evaluation) {
    if (state_ && state_->damaged_reply && state_->failed()) evaluation.descriptors.outcome.resize(most_outcomes + 1);
}

}   // namespace lore

#endif
