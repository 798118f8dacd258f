#pragma once

#include <lore/world/world.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lore {

/// How much a world is tried.
struct ContractConfig {
    int lives = 16;           ///< with effectors of their own; at most the world's max_batch are taken
    int steps = 1000;         ///< of each life, unless it is over before
    std::uint64_t seed = 1;   ///< of the effectors
};

/// A rule of lore/world.h, tried.
struct RuleReport {
    std::string rule;      ///< "values", "repeatable", ...
    std::string finding;   ///< what was tried; where the rule is broken, what breaks it: life, step, channel, numbers
    bool kept = true;
};

/// What the lives of the check have shown: no rule, but what an author wants to see.
struct WorldSample {
    int lives = 0;
    int ended = 0;                               ///< of them, before the last step
    double least_return = 0, most_return = 0;    ///< sums of rewards of a life
    std::vector<std::string> constant_sensors;   ///< had one value in all lives and steps
    bool effectors_matter = false;               ///< two lives with other effectors differed in anything
};

struct ContractReport {
    std::vector<RuleReport> rules;   ///< in the order tried; ends with "values" if that is broken
    WorldSample sample;              ///< of nothing where "values" is broken
    bool kept() const;
};

/// Tries whether a world keeps its contract: values in range; lives that are the same twice, in other places of a
/// batch, alone and in small batches, while other batches and a second world are under way, and after many were begun
/// and ended; sense and outcome that change nothing; memory that does not grow. `reopen` opens the same world again.
///
/// Effectors are drawn from `seed`: per life, held for 1 to 50 steps, at random, at their ends, or constant.
ContractReport check_contract(World const&, std::function<std::unique_ptr<World>()> const& reopen,
                              ContractConfig const&);

/// What speed is measured by: the processor time of this program, to which other work on the machine does not count; or
/// wall time, for a world that works elsewhere.
enum class Timekeeper { processor, wall };

/// Steps and lives a second, by batches of `lives`, measured for about `seconds`.
double measure_speed(World const&, int lives, double seconds, Timekeeper = Timekeeper::processor);

}   // namespace lore
