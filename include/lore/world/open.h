#pragma once

#include <lore/world/world.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace lore {

/// What a configuration says of its world.
struct WorldRequest {
    /// A built-in world and its task, "collectball:source"; a path with a '/', "worlds/pendulum.so"; or the name of a
    /// library to look for: "pendulum" is pendulum.so or libpendulum.so.
    std::string name;
    std::string settings;   ///< [world.settings] as lore/world.h has it: TomlTable::lines
    std::string
        folder;   ///< where paths begin and the search too: that of the configuration; "": the working directory
};

/// The table [world] of a configuration file, `library` and `settings`; an empty name where it has none. Looks at
/// nothing else of the file. Throws UsageError.
WorldRequest read_world_request(std::string const& config_file);

/// A world of this program. `open` throws UsageError for an unknown task and for settings that it does not know.
struct BuiltinWorld {
    std::string_view name;
    std::unique_ptr<World> (*open)(std::string const& task, std::string const& settings);
};

/// Where a world came from. Together with its facts it says whether files of one run fit another.
struct WorldOrigin {
    std::string file;             ///< as it was found; "" for a built-in world
    std::uint64_t checksum = 0;   ///< of the file
    std::uint64_t bytes = 0;
    std::string settings;
};

struct OpenedWorld {
    WorldOrigin origin;
    std::unique_ptr<World> world;
};

/// The file of the library that `name` means. One without a '/' is looked for in `folder`, then in the folders of
/// LORE_WORLD_PATH (separated by ':'), then in lib/lore/worlds beside the folder of the program.
/// Throws UsageError with the places where it is not found.
std::string find_library(std::string const& name, std::string const& folder);

/// Throws UsageError: no such built-in world or file, refused settings; Error: as load_world.
OpenedWorld open_world(WorldRequest const&, std::span<BuiltinWorld const>);

}   // namespace lore
