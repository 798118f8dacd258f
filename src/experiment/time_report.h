#pragma once

#include <lore/cluster/farm.h>

#include <string>
#include <vector>

namespace lore {

/// Where the wall time of rank 0 went besides the farm's own accounts [s].
struct MasterTimes {
    double start = 0;       ///< configuration, world, knowledge base, founders: all before the first generation
    double selection = 0;   ///< breeding, ranking, choosing
    double files = 0;
    double wall = 0;
};

/// A table in percent of the wall time, a row a rank.
std::string time_report(std::vector<RankTimes> const&, MasterTimes const&);

}   // namespace lore
