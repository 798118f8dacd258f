#pragma once

#include "run_setup.h"

namespace lore {

/// Takes up the run in the directory of `setup`: its configuration with what the command line changes, its arena,
/// knowledge base, manifest and checkpoint. Throws UsageError: the command line contradicts the run; Error: a file
/// cannot be read.
void resume(RunSetup& setup, RunOptions const&);

/// Sets the digest, and holds the checkpoint, if there is one, against it. Throws UsageError: the files of the
/// directory are not those that the checkpoint was made with.
void check_digest(RunSetup& setup);

}   // namespace lore
