#pragma once

#include <lore/world/world.h>

#include <memory>
#include <string>
#include <vector>

namespace lore {

/// A program that is a world: what [world] of a configuration says of it.
struct WorldProcess {
    std::vector<std::string> command;   ///< the program, looked for along PATH unless it has a '/', and its arguments
    std::string folder;     ///< where it starts, so that relative paths begin there; "": the working directory
    double patience = 60;   ///< longest time for one answer, its start included [s]
};

/// The world that a program makes of `settings` (TomlTable::lines). It reads frames from its standard input and
/// answers with frames on its standard output (docs/manual/formats.md); its standard error is that of this program.
///
/// The program is started once, in a process group of its own, and lives as long as the World: its input is closed
/// then, and what is left of the group 2 s later is killed. On Linux it is killed too where the thread that started it
/// dies. A step of a batch is one frame each way. Each value that comes back is checked: Life and Lives throw Error
/// with the world, the step and the reason where a value is wrong as in library.h. They throw it, too, where the
/// program ends, fails, sends something else than the answer, or does not answer in time; it is killed then, and every
/// later call throws the same. From the first world on this program ignores SIGPIPE, unless it handles it.
///
/// Throws UsageError where the program cannot be started or refuses the settings; Error where it ends, fails, sends
/// something else or is silent, is of another version, or states facts that break a rule.
std::unique_ptr<World> start_world(WorldProcess const&, std::string const& settings);

}   // namespace lore
