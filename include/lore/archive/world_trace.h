#pragma once

#include <lore/episode/episode.h>

#include <string>

namespace lore {

/// The text of trace.csv for any world: step,x,y,in0 ..,a0 ..,reward; a row a step of the controller's evaluation.
/// Position and sensors are those before the step's action, the reward is the step's. Numbers in the shortest form that
/// reads back to the same float.
std::string trace_csv(World const&, Network const&, EpisodeConfig const&);

}   // namespace lore
