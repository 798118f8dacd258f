#pragma once

#include <lore/world/process.h>
#include <lore/world/world.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// What a configuration says of its world.
struct WorldRequest {
    /// A built-in world and its task, "collectball:source"; a path with a '/', "worlds/pendulum.so"; or the name of a
    /// library to look for: "pendulum" is pendulum.so or libpendulum.so.
    std::string name;
    std::string settings;   ///< [world.settings] as lore/world.h has it: TomlTable::lines
    /// Where paths begin and the search too: that of the configuration; "": the working directory.
    std::string folder;
    std::vector<std::string> process{};          ///< the command of a process (WorldProcess); the name is "" then
    double patience = WorldProcess{}.patience;   ///< with it [s]
};

/// A world of this program. `open` throws UsageError for an unknown task and for settings that it does not know.
struct BuiltinWorld {
    std::string_view name;
    std::unique_ptr<World> (*open)(std::string const& task, std::string const& settings);
};

/// Where a world came from. Together with its facts it says whether files of one run fit another.
struct WorldOrigin {
    std::string file;             ///< the library, as it was found; "" for other worlds
    std::uint64_t checksum = 0;   ///< of the library; of a process, of those words of its command that are files
    std::uint64_t bytes = 0;      ///< of the same
    std::string settings;
    std::vector<std::string> command{};   ///< of a process
};
/// What messages call it: "./pendulum.so", "python3 cartpole.py", "" for a built-in world.
std::string text(WorldOrigin const&);

/// The words of a process's command that are files, as they are found from `folder`: "cartpole.py", not what is looked
/// for along PATH. What these files load is not among them.
std::vector<std::string> files_of(std::vector<std::string> const& command, std::string const& folder);

struct OpenedWorld {
    WorldOrigin origin;
    std::unique_ptr<World> world;
};

/// The file of the library that `name` means. One without a '/' is looked for in `folder`, then in the folders of
/// LORE_WORLD_PATH (separated by ':'), then in lib/lore/worlds beside the folder of the program.
/// Throws UsageError with the places where it is not found.
std::string find_library(std::string const& name, std::string const& folder);

/// The files that the world is made of: its library, or those of its process's command; none of a built-in world.
/// Opens nothing. Throws UsageError as find_library.
std::vector<std::string> files_of(WorldRequest const&, std::span<BuiltinWorld const>);

/// Throws UsageError: no such built-in world or file, a command that cannot be started, refused settings; Error: as
/// load_world and start_world.
OpenedWorld open_world(WorldRequest const&, std::span<BuiltinWorld const>);

}   // namespace lore
