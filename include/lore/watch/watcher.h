#pragma once

#include <lore/campaign/replay.h>
#include <lore/watch/facts.h>

#include <memory>
#include <string>
#include <vector>

namespace lore {

/// Looks at a campaign's directory again and again, and never writes there.
///
/// It remembers what it has read, so that a look costs the steps' states and the progress of the runs that have moved.
/// One thread at a time.
class CampaignWatcher {
public:
    /// Throws Error and UsageError as read_campaign does.
    CampaignWatcher(std::string file, std::string directory);
    ~CampaignWatcher();
    CampaignWatcher(CampaignWatcher const&) = delete;
    CampaignWatcher& operator=(CampaignWatcher const&) = delete;

    /// The facts as of now. Does not throw for what the disk says: a directory that is missing, a damaged file or a
    /// campaign's file that was changed for the worse becomes the notice, with the facts that were seen last.
    CampaignFacts look();

    /// The champions of the last look, simulated: those without a problem, in that order.
    std::vector<Replay> replays() const;

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

}   // namespace lore
