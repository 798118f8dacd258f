#pragma once

#include <lore/knowledge/value.h>

namespace lore {

/// Knowledge bases made from knowledge bases. Each returns a new one with the old one's provenance, to whose derivation
/// it adds a line; kind becomes "random", "permuted" or "reduced", but for revalue. Evidence goes with its features.

/// "KB random": values uniform between the smallest and the largest value of `base`, drawn in the order of the
/// features from the stream (seed, randomize).
KnowledgeBase randomize(KnowledgeBase const& base, std::uint64_t seed);
/// "KB permuted": the values of `base`, shuffled among its features by the stream (seed, permute). Where randomize
/// makes every value its own, this keeps how many features share one.
KnowledgeBase permute(KnowledgeBase const& base, std::uint64_t seed);
/// Values by another rule, from the evidence. kind stays, but "random" and "permuted" become "revalued". Throws
/// UsageError as values_by does.
KnowledgeBase revalue(KnowledgeBase const& base, ValueConfig const&);
/// The `count` features of highest value (ties: the lower number), in their old order.
KnowledgeBase keep_top(KnowledgeBase const& base, int count);
KnowledgeBase keep_valued(KnowledgeBase const& base, double least_value);
/// The features that at least so many individuals have shown: their values are means of as many rewards.
KnowledgeBase keep_shown(KnowledgeBase const& base, int least_count);
/// The features of `base` that match, by its threshold, some feature in every one of `others` (paper, Conclusion:
/// future work). Throws UsageError if their window lengths or channels differ.
KnowledgeBase keep_consensus(KnowledgeBase const& base, std::span<KnowledgeBase const> others);

}   // namespace lore
