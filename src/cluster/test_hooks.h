#pragma once

#include <lore/evaluation/evaluation.h>

#include <memory>

/// What tests ask of a rank by environment variables, in builds with LORE_TEST_HOOKS (CMakeLists.txt); other builds
/// read none of them.
///
/// LORE_TEST_DELAY=MS delays every genome by up to so many milliseconds. LORE_TEST_FAIL=RANK:N[:memory] lets genome
/// number N of that rank, from 0, throw whenever it is evaluated; with :reply the rank's evaluations from then on are
/// ones that rank 0 cannot read.
namespace lore {

#ifdef LORE_TEST_HOOKS

class TestHooks {
public:
    explicit TestHooks(int rank);
    ~TestHooks();
    void before_evaluation(Genome const&);
    void before_delivery(Evaluation&);

private:
    struct State;
    std::unique_ptr<State> state_;   ///< null where nothing is asked for
};

#else

struct TestHooks {
    explicit TestHooks(int) {}
    void before_evaluation(Genome const&) {}
    void before_delivery(Evaluation&) {}
};

#endif

}   // namespace lore
