#include <lore/campaign/worlds.h>

#include "treatment_inputs.h"

#include <lore/core/error.h>
#include <lore/experiment/run_world.h>

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

/// Channels of the worlds that were opened: many treatments share one.
class OpenedChannels {
public:
    explicit OpenedChannels(CampaignPlan const& plan) : plan_(plan) {}

    Channels const& of(Treatment const& treatment) {
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

private:
    CampaignPlan const& plan_;
    std::map<std::string, Channels> channels_;
};

}   // namespace

void check_worlds(CampaignPlan const& plan) {
    OpenedChannels opened{plan};
    Channels const source = opened.of(plan.source);
    for (Treatment const& target : plan.targets) {
        Channels const& channels = opened.of(target);
        for (TreatmentInput const& input : treatment_inputs()) {
            if ((target.*input.name).empty()) continue;
            if (std::string const why = why_misfit(source, channels); !why.empty())
                throw UsageError(fmt::format("{}: treatment '{}' cannot take {} = '{}'", plan.path, target.name,
                                             input.key, target.*input.name),
                                 why, "Give it a task whose world has the channels of the source task.");
        }
    }
}

}   // namespace lore
