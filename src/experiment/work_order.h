#pragma once

#include <lore/cluster/farm.h>
#include <lore/experiment/run_world.h>

#include <string>

namespace lore {

/// What every rank must know to evaluate. Rank 0 reads the files and sends their text, so that all work with the same
/// whatever happens to the files meanwhile; only the knowledge base is opened by each, to be shared by a node's ranks.
struct WorkOrder {
    ExperimentConfig config;
    std::string arena_text;             ///< "" of another world than collectball
    std::uint64_t world_checksum = 0;   ///< of its library, that every rank must find; 0: none
    std::string knowledge_path;         ///< absolute, or empty
    std::string knowledge_checksum;     ///< that every rank must find

    /// Evolution is to be shaped by the knowledge base at `path`. Throws Error: it cannot be read.
    void take_knowledge(std::string const& path);
};

/// Takes the world that the order's configuration asks for. Throws Error: it is not the one that rank 0 has, or the
/// knowledge base is missing or damaged, or does not fit.
EvaluationContext context_of(WorkOrder const&, RunWorld);

/// Rank 0: gives the order, and hears from every rank that it can work. Returns the ranks' host names.
/// Throws Error with the first complaint; all ranks are released then.
std::vector<std::string> give_order(Session const&, WorkOrder const&);

}   // namespace lore
