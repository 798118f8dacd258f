#pragma once

#include <lore/experiment/run_directory.h>
#include <lore/knowledge/index.h>

#include <cstdint>
#include <functional>

namespace lore {

/// Told how many individuals have been taken up so far, and how many features they showed.
using BuildingObserver = std::function<void(std::int64_t individuals, std::int64_t features)>;

/// The windows of an archived individual are not stored: it is simulated again, which repeats its evaluation exactly.
/// Both functions throw Error if a repeated evaluation does not deliver the archived number of balls. A thread
/// simulates a batch while others match the former one, one a processor; the result does not depend on how many. Memory
/// is bounded by a few batches and the base itself.
///
/// Of `provenance` the caller sets made_by; kind, index, sources, task and the counts are filled in here.

/// Algorithm 1 over the lineage of `individual`, itself first.
KnowledgeBase knowledge_of_lineage(RunDirectory const&, Birth const& individual, KnowledgeConfig const&, IndexKind,
                                   Provenance, BuildingObserver const&);
/// The same over all individuals ever evaluated, in order of birth ("KB all"); over the first and every `every`-th
/// after it, if that is not 1. Throws Error if the run did not keep them.
KnowledgeBase knowledge_of_all(RunDirectory const&, int every, KnowledgeConfig const&, IndexKind, Provenance,
                               BuildingObserver const&);

/// How many individuals the run archived (--archive all).
std::uint64_t archived_individuals(RunDirectory const&);

}   // namespace lore
