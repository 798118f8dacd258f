#pragma once

#include "work_order.h"

#include <lore/archive/checkpoint.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run.h>

#include <optional>
#include <string>

namespace lore {

/// Holds a run's directory against other processes until it is destroyed. Throws Error if another one has it.
class DirectoryLock {
public:
    explicit DirectoryLock(std::string const& directory);
    ~DirectoryLock();
    DirectoryLock(DirectoryLock const&) = delete;
    DirectoryLock& operator=(DirectoryLock const&) = delete;

private:
    int file_ = -1;
};

/// A run about to start or to go on: options, configuration and what the directory holds, reconciled.
struct RunSetup {
    std::string directory;
    WorkOrder order;
    std::uint64_t seed = 1;
    std::uint64_t digest = 0;              ///< of all that results depend on
    bool archive_all = false;
    Manifest manifest;                     ///< inputs and former sessions
    std::optional<Checkpoint> checkpoint;  ///< to go on from
    std::string warning;
    bool already_done = false;

    std::string file(std::string_view name) const;
};

/// Makes the directory if need be, and takes the lock before looking into it.
struct PreparedRun {
    std::unique_ptr<DirectoryLock> lock;
    RunSetup setup;
};
/// Throws UsageError: the directory holds a run and --resume was not given, or the options contradict the run resumed.
PreparedRun prepare_run(RunOptions const&);

} // namespace lore
