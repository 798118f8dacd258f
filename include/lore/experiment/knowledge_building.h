#pragma once

#include <lore/experiment/run_directory.h>
#include <lore/knowledge/index.h>

#include <cstdint>
#include <functional>
#include <optional>

namespace lore {

/// Told how many individuals have been taken up so far, and how many features they showed.
using BuildingObserver = std::function<void(std::int64_t individuals, std::int64_t features)>;

/// The windows of an archived individual are not stored: it is simulated again, which repeats its evaluation exactly.
/// Both functions throw Error if a repeated evaluation does not give the archived reward. A thread
/// simulates a batch while others match the former one, one a processor; the result does not depend on how many. Memory
/// is bounded by a few batches and the base itself.
///
/// Of `provenance` the caller sets made_by; kind, index, sources, task and the counts are filled in here.

/// Discounts whose returns a build gathers if nothing else is said: half of a reward is left after 69, 138 and 346
/// steps.
std::vector<double> default_gammas();
/// The reward that makes a success if nothing else is said: half of the best-of-run's, of whole rewards rounded up and
/// at least 1.
double usual_success(double best);

/// Algorithm 1 over the lineage of `individual`, itself first. Gathers evidence of credit and of returns for `gammas`.
KnowledgeBase knowledge_of_lineage(RunDirectory const&, Birth const& individual, KnowledgeConfig const&, IndexChoice,
                                   Provenance, BuildingObserver const&, std::vector<double> gammas = default_gammas());
/// The same over all individuals ever evaluated, in order of birth ("KB all"); over the first and every `every`-th
/// after it, if that is not 1. Throws Error if the run did not keep them. Gathers evidence of contrast and of returns.
/// `success_reward`: so much makes a success; none: usual_success. `folder`: where files without a name keep the
/// windows of features until the base is gone, if the index is an exact one, since of many they would not fit into
/// memory; empty: in memory.
KnowledgeBase knowledge_of_all(RunDirectory const&, int every, KnowledgeConfig const&, IndexChoice, Provenance,
                               BuildingObserver const&, std::vector<double> gammas = default_gammas(),
                               std::optional<double> success_reward = {}, std::string const& folder = {});

/// How many individuals the run archived (--archive all).
std::uint64_t archived_individuals(RunDirectory const&);

}   // namespace lore
