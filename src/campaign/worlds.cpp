#include <lore/campaign/worlds.h>

#include "opened_channels.h"
#include "treatment_inputs.h"

#include <lore/core/error.h>

#include <fmt/format.h>

namespace lore {

void check_worlds(CampaignPlan const& plan) {
    OpenedChannels opened{plan};
    for (Treatment const& source : plan.sources) opened.of(source);
    for (Treatment const& target : plan.targets) {
        Channels const& channels = opened.of(target);   // stays where it is as more are opened
        for (TreatmentInput const& input : treatment_inputs()) {
            for (std::string const& name : target.*input.names) {
                Channels const& source = opened.of(plan.treatment(plan.knowledge_base(name).source));
                if (std::string const why = why_misfit(source, channels); !why.empty())
                    throw UsageError(fmt::format("{}: treatment '{}' cannot take {} = '{}'", plan.path, target.name,
                                                 input.key, name),
                                     why, "Give it a task whose world has the channels of the source task.");
            }
        }
    }
}

}   // namespace lore
