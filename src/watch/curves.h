#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lore {

/// Tells whether a file is still the one that was read.
struct FileStamp {
    std::uint64_t inode = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;   ///< of its last change
    friend bool operator==(FileStamp const&, FileStamp const&) = default;
};
/// All 0 where there is no such file.
FileStamp stamp_of(std::string const& path);

/// The best reward by generation of many runs; a run is read again only when its progress.csv has changed.
class ProgressMemory {
public:
    /// From generation 0; empty if there is nothing to read. A file that is damaged gives what was read last.
    std::vector<double> const& best_rewards(std::string const& run_directory);

private:
    struct Entry {
        FileStamp stamp;
        std::vector<double> rewards;
    };
    std::map<std::string, Entry> entries_;
};

}   // namespace lore
