#include "lane_kernel.h"

#include <lore/maze/rules.h>

namespace lore::LORE_ISA_NAMESPACE {

void run_mazes(LaneRulesWork const& work) { run_rules<MazeRules, LORE_LANES>(work); }

}   // namespace lore::LORE_ISA_NAMESPACE
