#pragma once

#include <lore/cluster/farm.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lore {

/// What a session of a run will take, from its first generations. The founders' is none of them: it evaluates others,
/// and more.
class CostForecast {
public:
    /// `reached` is the last generation that is complete, -1 before the founders'; the session goes on to `generations`
    /// on so many ranks. Times are seconds on any clock.
    CostForecast(int reached, int generations, int ranks, double now)
        : first_(reached), generations_(generations), ranks_(ranks), began_(now) {}

    /// To be asked at the end of every generation. A line, once: as soon as the generations so far have lasted half a
    /// second, so that the shortest runs tell nothing; else "".
    std::string after(int generation, double now);

private:
    int first_, generations_, ranks_;
    double began_;
    bool told_ = false;
};

/// What a session has cost: processor time of all ranks until the farm stopped, steps, and steps a second of `seconds`
/// of its generations.
std::string cost_report(std::vector<RankTimes> const&, std::uint64_t steps, double seconds);

}   // namespace lore
