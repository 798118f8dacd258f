#pragma once

#include <lore/watch/facts.h>

#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// The whole picture, for a terminal: the treatments, the runs at work, the failures, and the campaign in the last
/// line.
std::vector<std::string> picture_of(CampaignFacts const&);

/// One line for the campaign as a whole.
std::string summary_of(CampaignFacts const&);

/// A line for every step whose state has changed, and for a new notice: where there is no terminal.
std::vector<std::string> changes_between(CampaignFacts const& before, CampaignFacts const& now);

}   // namespace lore
