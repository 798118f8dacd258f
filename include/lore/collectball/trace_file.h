#pragma once

#include <lore/collectball/replay.h>

#include <string>
#include <vector>

namespace lore {

/// The text of trace.csv: a header and a row a step, numbers in the shortest form that reads back to the same float.
std::string trace_csv(std::vector<StepRecord> const&);

/// Reads what trace_csv wrote, or a trace of the same columns from elsewhere: plain or gzip-compressed, columns in any
/// order, further columns ignored. Throws Error with the line: a column missing, a row too short, a number malformed,
/// not finite or out of range, balls that the arena's task does not have, a pose outside the arena, no row at all.
std::vector<StepRecord> read_trace_csv(std::string const& path, Arena const&);

/// The columns a0, a1, a2 of such a file, each in [0, 1].
std::vector<Effectors> read_actions_csv(std::string const& path);

}   // namespace lore
