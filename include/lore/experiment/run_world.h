#pragma once

#include <lore/archive/world_record.h>
#include <lore/experiment/config.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// The worlds of this program: collectball and maze.
std::span<BuiltinWorld const> builtin_worlds();

/// The world of a run, opened, and where it came from.
struct RunWorld {
    std::shared_ptr<World const> world;
    WorldOrigin origin;
    WorldRecord record() const { return world_record(world->facts(), origin); }
};

/// The text of the configuration's arena file, or of the built-in arena; "" where the world is another than
/// collectball. Throws UsageError as arena_text.
std::string arena_text_of(ExperimentConfig const&);
/// The files that the world is made of: the arena's, the library, or those of a process's command; none of what is
/// built in. Opens nothing. Throws UsageError: the library is not found.
std::vector<std::string> world_files(ExperimentConfig const&);
/// The world that the configuration asks for: [world], or else collectball with this arena. Throws UsageError: there is
/// no such world, it refuses its settings, or a setting of collectball alone is given to another; Error: as open_world.
RunWorld open_run_world(ExperimentConfig const&, std::string_view arena_text);

}   // namespace lore
