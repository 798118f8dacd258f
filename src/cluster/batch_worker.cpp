#include "batch_worker.h"

#include <lore/core/random.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>

namespace lore {

namespace {

struct TestHooks {
    double longest_delay_ms = 0;
    long failing_batch = -1;
    bool out_of_memory = false;
};

TestHooks hooks_from_environment(int rank) {
    TestHooks hooks;
    if (char const* const delay = std::getenv("LORE_TEST_DELAY")) hooks.longest_delay_ms = std::atof(delay);
    if (char const* const fail = std::getenv("LORE_TEST_FAIL")) {
        char* rest = nullptr;
        if (std::strtol(fail, &rest, 10) == rank && *rest == ':') hooks.failing_batch = std::strtol(rest + 1, &rest, 10);
        hooks.out_of_memory = std::strcmp(rest, ":memory") == 0;
    }
    return hooks;
}

std::string reason_of_current_exception() {
    try {
        throw;
    } catch (std::bad_alloc const&) {
        return "out of memory";
    } catch (std::exception const& error) {
        return error.what();
    } catch (...) {
        return "an exception of unknown type";
    }
}

} // namespace

BatchEvaluation with_test_hooks(BatchEvaluation evaluate, int rank) {
    TestHooks const hooks = hooks_from_environment(rank);
    if (hooks.longest_delay_ms <= 0 && hooks.failing_batch < 0) return evaluate;
    Stream const rng{static_cast<std::uint64_t>(rank), Purpose::test};
    return [=, rng = rng, batches = 0L, victim = Genome{}](std::span<Genome const* const> genomes) mutable {
        if (hooks.longest_delay_ms > 0)
            std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(rng.uniform() * hooks.longest_delay_ms));
        if (batches++ == hooks.failing_batch) victim = *genomes.back();
        for (Genome const* genome : genomes)
            if (!victim.edges.empty() && *genome == victim) {
                if (hooks.out_of_memory) throw std::bad_alloc{};
                throw std::runtime_error("a failure that the test asked for");
            }
        return evaluate(genomes);
    };
}

BatchOutcome evaluate_guarded(BatchEvaluation const& evaluate, std::span<Genome const* const> genomes) {
    std::string reason;
    try {
        return {evaluate(genomes), std::nullopt};
    } catch (...) {
        reason = reason_of_current_exception();
    }
    for (std::size_t place = 0; place < genomes.size(); ++place) {
        try {
            evaluate(genomes.subspan(place, 1));
        } catch (...) {
            return {{}, Culprit{place, reason_of_current_exception()}};
        }
    }
    return {{}, Culprit{0, reason + ", but not when repeated one by one"}};
}

} // namespace lore
