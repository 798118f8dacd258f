#include "curves.h"

#include <lore/core/error.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>
#include <lore/watch/facts.h>

#include <algorithm>
#include <filesystem>

#include <sys/stat.h>

namespace lore {

namespace {

/// What a chart can show.
constexpr std::size_t most_points = 201;

}   // namespace

FileStamp stamp_of(std::string const& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return {};
    return {static_cast<std::uint64_t>(status.st_ino), static_cast<std::uint64_t>(status.st_size),
            status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::vector<double> const& ProgressMemory::best_rewards(std::string const& run_directory) {
    std::string const path = (std::filesystem::path{run_directory} / run_file::progress).string();
    Entry& entry = entries_[path];
    FileStamp const stamp = stamp_of(path);
    if (stamp == entry.stamp) return entry.rewards;
    // Stamped before it is read: rows that come meanwhile are read next time.
    entry.stamp = stamp;
    if (stamp == FileStamp{}) {
        entry.rewards.clear();
        return entry.rewards;
    }
    try {
        std::vector<double> rewards;
        for (GenerationSummary const& row : read_progress(path)) rewards.push_back(row.best_reward);
        entry.rewards = std::move(rewards);
    } catch (Error const&) {
        // Removed meanwhile, or damaged: the run's state says which.
    }
    return entry.rewards;
}

std::vector<MeanPoint> mean_curve(std::vector<std::vector<double>> const& runs) {
    std::size_t length = 0;
    for (std::vector<double> const& run : runs) length = std::max(length, run.size());
    std::vector<MeanPoint> curve;
    if (length == 0) return curve;
    std::size_t const stride = std::max<std::size_t>(1, (length - 1 + most_points - 2) / (most_points - 1));
    for (std::size_t g = 0;; g = std::min(g + stride, length - 1)) {
        MeanPoint point{static_cast<int>(g), 0, 0};
        for (std::vector<double> const& run : runs) {
            if (run.size() <= g) continue;
            point.mean += run[g];
            ++point.runs;
        }
        point.mean /= point.runs;   // the longest run is among them
        curve.push_back(point);
        if (g == length - 1) return curve;
    }
}

}   // namespace lore
