#pragma once

#include "run_setup.h"

#include <lore/archive/all_individuals.h>
#include <lore/experiment/progress_file.h>

#include <chrono>
#include <optional>
#include <string>

namespace lore {

/// What a run keeps in its directory while it goes on: progress, archive, checkpoints, manifest.
class RunBooks {
public:
    /// `nothing_shown`: as summarize has it.
    RunBooks(RunSetup, std::vector<std::string> hosts, std::string command_line, double nothing_shown);

    /// Enters a generation.
    GenerationSummary const& add(GenerationReport const&);
    /// Whether the configuration asks for a checkpoint now.
    bool checkpoint_is_due() const;
    /// Everything on disk is consistent with `state` when it returns, and durable.
    void write_checkpoint(EvolutionState const& state);
    /// Writes what only a stop or the end brings: last checkpoint, lineage, manifest with checksums.
    void close(EvolutionState const& state, RunStatus, std::string const& reason);

    double session_seconds() const;
    /// Recorded in this session, as in progress.csv.
    std::uint64_t session_steps() const { return row_.steps - former_steps_; }
    /// Spent on files so far [s].
    double filing_seconds() const { return filing_seconds_; }
    std::string const& reward_unit() const { return setup_.manifest.world.reward_unit; }

private:
    using Clock = std::chrono::steady_clock;   // never jumps
    /// As they are at a checkpoint, or empty.
    void open_outputs(Checkpoint const* from);
    void write_manifest_now();

    RunSetup setup_;
    double nothing_shown_;
    double former_seconds_ = 0;
    std::uint64_t former_steps_ = 0;
    GenerationSummary row_;
    std::optional<ProgressWriter> progress_;
    std::optional<AllIndividualsWriter> all_;
    Clock::time_point began_ = Clock::now(), last_checkpoint_ = Clock::now();
    int last_checkpoint_generation_ = -1;
    double filing_seconds_ = 0;
};

}   // namespace lore
