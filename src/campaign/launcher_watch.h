#pragma once

#include <chrono>
#include <optional>
#include <string_view>

#include <sys/types.h>

namespace lore {

/// Processes of one name among the descendants of a launcher.
struct Ranks {
    int living = 0;
    int dead = 0;   ///< zombies: their parent has not waited for them yet
};

/// Descendants of `launcher` that run the program of this name (without its directory, at most 15 characters),
/// at any depth. Source: /proc/PID/task/*/children; none where the kernel does not have it.
Ranks ranks_of(pid_t launcher, std::string_view program);

/// Notices an MPI launcher that outlives its ranks. Open MPI's mpirun may wait for ever in PMIx_server_finalize after
/// its ranks were killed.
///
/// A launcher hangs if it has had a rank and then none for `patience`. A launcher that has not started a rank yet does
/// not hang, nor does one whose ranks are not its descendants (those of a batch system).
class LauncherWatch {
public:
    using Clock = std::chrono::steady_clock;
    explicit LauncherWatch(std::chrono::duration<double> patience) : patience_(patience) {}

    /// Takes the ranks as they are now, and returns whether the launcher hangs. To be called about once a second: a
    /// rank that lives for a shorter time, and that the launcher has waited for, is not noticed.
    bool hangs(Ranks, Clock::time_point now);

private:
    std::chrono::duration<double> patience_;
    bool had_rank_ = false;
    std::optional<Clock::time_point> alone_since_;
};

}   // namespace lore
