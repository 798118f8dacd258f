#pragma once

#include <lore/campaign/plan.h>
#include <lore/world/channels.h>

#include <map>
#include <string>

namespace lore {

/// Channels of the worlds of a campaign's treatments, each opened once: many treatments share one.
class OpenedChannels {
public:
    explicit OpenedChannels(CampaignPlan const& plan) : plan_(plan) {}

    /// Stays valid. Throws UsageError, which names the treatment: its world cannot be opened.
    Channels const& of(Treatment const&);

private:
    CampaignPlan const& plan_;
    std::map<std::string, Channels> channels_;
};

}   // namespace lore
