#pragma once

#include <lore/campaign/replay.h>

#include <optional>
#include <string>

namespace lore {

/// Why the files of the step "replay" in `into` do not show what is there by now in the campaign's directory `from`:
/// "not made yet", "it should show kb1/007". Nothing if they do, or if there is nothing to show yet.
std::optional<std::string> replay_is_due(CampaignPlan const&, CampaignDirectory const& from,
                                         CampaignDirectory const& into);

/// Whether the source run that figures 5 and 6 show was chosen and is finished.
bool can_replay(CampaignPlan const&, CampaignDirectory const&);

/// Simulates the best-of-run of a finished run, by its step's name. Throws Error: not finished, or a damaged file.
Replay replay_of(CampaignDirectory const&, std::string const& step);

/// The step "replay": simulates the best of the source run that figures 5 and 6 show and the best finished
/// run on each target task, looks the first one's windows up in those knowledge bases of the figures that are there,
/// and writes the files. Throws Error: no such source run yet, a damaged file, bases of several window lengths in
/// figure 6.
void make_replays(CampaignPlan const&, CampaignDirectory const& from, CampaignDirectory const& into);

}   // namespace lore
