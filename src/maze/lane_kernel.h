#pragma once

#include <lore/core/isa.h>
#include <lore/episode/lane_rules.h>

namespace lore {

LORE_KERNEL(void run_mazes(LaneRulesWork const&))

}   // namespace lore
