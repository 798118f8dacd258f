#pragma once

#include <lore/world/world.h>

#include <memory>
#include <string>

namespace lore {

/// The world that a shared library makes of `settings` (lore/world.h, the C interface; TomlTable::lines).
///
/// Its batches step through the library in one call; a Life is a batch of one. Each value that comes back is checked:
/// Life and Lives throw Error with the world, the step, the life, the channel and the number where one is not written,
/// is NaN or out of range, where the library writes behind an array, or cannot begin. From the first world on, a fatal
/// signal within a library's code prints a line that names the world before it takes its course.
///
/// Throws UsageError where the library refuses the settings; Error where the file is no shared library, lacks the
/// function lore_world, is of another version, lacks a function, or states facts that break a rule.
std::unique_ptr<World> load_world(std::string const& file, std::string const& settings);

/// From now on the program ends, with a line that names the world and exit code 1, where one call into a library takes
/// longer than this [s of wall clock, at least 1]. Takes SIGALRM and the process's interval timer.
void limit_world_calls(int seconds);

}   // namespace lore
