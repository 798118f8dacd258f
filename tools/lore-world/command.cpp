#include "command.h"

#include <lore/experiment/run_world.h>

#include <filesystem>

#include <fmt/format.h>

namespace lore::world {

void add_world(CLI::App* command, WorldOptions& options) {
    command->add_option("WORLD", options.world,
                        "path of a library (with a '/'), name of one to look for, or built-in world and its task "
                        "(collectball:source, maze:hard)");
    command->add_option("--config", options.config,
                        "configuration whose [world] names the library or the process and holds its settings");
}

WorldRequest request_for(WorldOptions const& options) {
    if (options.world.ends_with(".toml"))
        throw UsageError(fmt::format("{} is not a world", options.world), "it is the name of a configuration",
                         fmt::format("Say --config {}.", options.world));
    WorldRequest request;
    if (!options.config.empty()) {
        request = read_config(options.config).world;
        // Of a configuration that names no world, which then is to be named here.
        if (request.folder.empty()) request.folder = std::filesystem::path{options.config}.parent_path().string();
    }
    if (!options.world.empty()) {
        request.name = options.world;
        request.process.clear();
        // A path on the command line begins where the user is; a name is looked for beside the configuration.
        if (options.world.find('/') != std::string::npos) request.folder.clear();
    }
    bool const is_named = !request.name.empty() || !request.process.empty();
    if (!is_named && options.config.empty())
        throw UsageError("no world is named", "WORLD or --config is expected", "See 'lore-world --help'.");
    if (!is_named)
        throw UsageError(fmt::format("{} names no world", options.config),
                         "it has no world.library and no world.process", "Add one of them, or name WORLD as well.");
    return request;
}

OpenedWorld open_world(WorldRequest const& request) { return lore::open_world(request, builtin_worlds()); }

std::string called(OpenedWorld const& opened) {
    std::string const name = title(opened.world->facts()), origin = text(opened.origin);
    return origin.empty() ? name : fmt::format("{} from {}", name, origin);
}

}   // namespace lore::world
