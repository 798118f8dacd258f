#pragma once

#include "work_order.h"

#include <lore/archive/checkpoint.h>
#include <lore/archive/file_lock.h>
#include <lore/archive/lineage_file.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run.h>

#include <optional>
#include <string>

namespace lore {

/// A run about to start or to go on: options, configuration and what the directory holds, reconciled.
struct RunSetup {
    std::string directory;
    ConfigFile given;   ///< on the command line; without a path: none
    WorkOrder order;
    std::uint64_t seed = 1;
    std::uint64_t digest = 0;         ///< of all that results depend on
    bool has_former_digest = false;   ///< the checkpoint's is of the former kind
    bool archive_all = false;
    bool founders_are_due = false;          ///< generation 0 is still to be made from founders.from
    std::vector<Genome> founders;           ///< then
    Manifest manifest;                      ///< inputs and former sessions
    std::optional<Checkpoint> checkpoint;   ///< to go on from
    std::string warning;
    bool already_done = false;

    std::string file(std::string_view name) const;
    std::optional<FoundersOrigin> founders_origin() const;   ///< as the manifest's inputs say
};

/// True if the command line itself says that the reward is not shaped. (Of a configuration --kb is stronger.)
bool forbids_shaping(RunOptions const&);

struct PreparedRun {
    std::optional<FileLock> lock;   ///< of the directory, against other processes
    RunSetup setup;
    EvaluationContext context;   ///< of rank 0
};
/// Checks all that can be checked before anything is sent to the other ranks. The directory of a new run is made last,
/// so that a refused one leaves nothing behind; that of a run to be resumed is locked before it is read.
/// Throws UsageError: the directory holds a run and --resume was not given, or the options contradict the run resumed;
/// Error: another process has the directory, or a file cannot be read or made.
PreparedRun prepare_run(RunOptions const&);

}   // namespace lore
