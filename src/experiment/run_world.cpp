#include <lore/experiment/run_world.h>

#include <lore/collectball/collectball.h>
#include <lore/core/error.h>
#include <lore/maze/maze.h>

#include <array>
#include <filesystem>

#include <fmt/format.h>

namespace lore {

namespace {

/// Of the settings that another world has no use for.
void refuse_settings_of_collectball(ExperimentConfig const& config) {
    ExperimentConfig const defaults;
    auto const refuse = [](std::string_view key) {
        throw UsageError(fmt::format("{} is set", key), "it belongs to collectball, and [world] names another world",
                         "Remove one of them.");
    };
    if (config.arena != defaults.arena) refuse("arena");
    if (config.task != defaults.task) refuse("task");
    if (config.stop_when_still != defaults.stop_when_still) refuse("episode.stop_when_still");
}

}   // namespace

std::span<BuiltinWorld const> builtin_worlds() {
    static std::array const worlds{collectball_world, maze_world};
    return worlds;
}

std::string arena_text_of(ExperimentConfig const& config) { return config.has_world() ? "" : arena_text(config.arena); }

std::vector<std::string> world_files(ExperimentConfig const& config) {
    if (config.has_world()) return files_of(config.world, builtin_worlds());
    bool const is_file = !is_builtin_arena(config.arena) && std::filesystem::is_regular_file(config.arena);
    return is_file ? std::vector{config.arena} : std::vector<std::string>{};
}

RunWorld open_run_world(ExperimentConfig const& config, std::string_view arena_text) {
    if (!config.has_world())
        return {std::make_shared<CollectballWorld>(parse_arena(arena_text, config.arena, config.task),
                                                   config.stop_when_still),
                {}};
    refuse_settings_of_collectball(config);
    OpenedWorld opened = open_world(config.world, builtin_worlds());
    return {std::move(opened.world), std::move(opened.origin)};
}

}   // namespace lore
