#include "opened_channels.h"

#include <lore/core/error.h>
#include <lore/experiment/run_world.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

Channels const& OpenedChannels::of(Treatment const& treatment) {
    std::string const path = plan_.config_path(treatment);
    ExperimentConfig const config = read_config(path, treatment.overrides);
    std::string const key = config.has_world()
                                ? fmt::format("{}\n{}\n{}\n{}", config.world.folder, config.world.name,
                                              fmt::join(config.world.process, "\n"), config.world.settings)
                                : fmt::format("\n{}\n{}", config.arena, config.task);
    auto const known = channels_.find(key);
    if (known != channels_.end()) return known->second;
    try {
        RunWorld const opened = open_run_world(config, arena_text_of(config));
        return channels_.emplace(key, Channels{opened.world->facts()}).first->second;
    } catch (Error const& error) {
        throw UsageError(fmt::format("cannot open the world of treatment '{}' ({})", treatment.name, path),
                         error.what(), fmt::format("Mend it, or the treatment in {}.", plan_.path));
    }
}

}   // namespace lore
