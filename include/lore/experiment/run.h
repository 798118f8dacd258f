#pragma once

#include <lore/cluster/session.h>
#include <lore/experiment/config.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lore {

/// What lore-evolve was asked for.
struct RunOptions {
    std::string config_path;              ///< may be empty where a run is resumed
    std::vector<std::string> overrides;   ///< "section.key=value"
    std::optional<std::uint64_t> seed;    ///< default 1, or that of the run resumed
    std::string directory;
    std::string knowledge_base;   ///< a path, or empty
    bool resume = false;
    bool archive_all = false;
    bool quiet = false;
    std::optional<double> max_seconds;   ///< of this session
    std::string command_line;            ///< for the manifest
};

struct RunOutcome {
    bool finished = false;     ///< else stopped at a checkpoint
    std::string stop_reason;   ///< where it was stopped
    std::string signature;
    int generation = 0;
    std::shared_ptr<Birth const> best;   ///< of the population reached
    std::string reward_unit;
};

/// A whole run on the ranks of a session, called on rank 0: evolves, keeps the books in options.directory, stops at a
/// checkpoint where asked to. Throws Error; if other ranks cannot be released then, it ends the session itself.
RunOutcome run_experiment(Session const&, RunOptions const&);

/// A small fixed run without files: its signature, and how fast it went.
struct BenchOutcome {
    std::string signature;
    double steps_per_second = 0;
};
BenchOutcome run_bench(Session const&);

/// What the other ranks do meanwhile: they wait for what to evaluate, and work until they are released.
void work_for_rank_0(Session const&);
/// For rank 0, where it has nothing for the others to do.
void release_other_ranks(Session const&);

}   // namespace lore
