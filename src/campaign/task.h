#pragma once

#include "launcher_watch.h"

#include <lore/archive/file_lock.h>
#include <lore/campaign/state.h>
#include <lore/campaign/steps.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace lore {

enum class Phase : std::uint8_t {
    waiting,     ///< for its turn, or for other steps
    working,     ///< a program of ours is at it
    elsewhere,   ///< another lore-campaign is at it
    done,
    failed,
    blocked   ///< waits for a step that has failed, or that is missing and not ours to do
};

/// A step of the campaign, and how far this session has brought it.
struct Task {
    explicit Task(Step of) : step(std::move(of)) {}

    Step step;
    Phase phase = Phase::waiting;
    int attempts = 0;      ///< failed ones of this session
    int generation = 0;    ///< last seen
    int generations = 0;   ///< that it is to reach; 0 if it is no run
    double best_reward = 0;
    std::string reward_unit;   ///< "" as long as it is not known
    double seconds = 0;        ///< spent on it in all sessions
    int started_at = 0;        ///< generation at the last start: a resume that gains nothing counts as a failure
    pid_t pid = 0;             ///< of the program at work on it; 0: none
    std::optional<FileLock> lock;
    std::optional<LauncherWatch> watch;   ///< of a run of several ranks
};

inline int count(std::vector<Task> const& tasks, Phase phase) {
    return static_cast<int>(
        std::count_if(tasks.begin(), tasks.end(), [&](Task const& task) { return task.phase == phase; }));
}

/// Tasks that are neither done nor lost.
inline int unfinished(std::vector<Task> const& tasks) {
    return count(tasks, Phase::waiting) + count(tasks, Phase::working) + count(tasks, Phase::elsewhere);
}

}   // namespace lore
