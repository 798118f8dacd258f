#pragma once

#include <memory>
#include <string>
#include <vector>

namespace lore {

/// What happens in runs, as a protocol of lines for trackers (docs/manual/formats.md, "Events"): a JSON object each.
///
/// Reads what a run writes anyway (config.toml, manifest.json, progress.csv, its checkpoint), so that a run does
/// nothing for it and cannot be slowed or stopped by it. A reader that is started later, or again, tells all of the
/// past first; only checkpoints are told of as they are seen. One thread at a time.
class EventReader {
public:
    /// `directory` is that of one run, or has runs somewhere below it; it may come later. Of the generations every
    /// `every`-th is told, and the last of a session.
    EventReader(std::string directory, int every);
    ~EventReader();
    EventReader(EventReader const&) = delete;
    EventReader& operator=(EventReader const&) = delete;

    /// The events since the last look, run by run, in the order of their paths, without the ends of lines. Does not
    /// throw for what the disk says: a run that cannot be read is an event of its own, once until it changes.
    std::vector<std::string> look();

    /// Runs that were found so far.
    std::size_t runs() const;
    /// The directory is that of one run, which has ended.
    bool ended() const;

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

}   // namespace lore
