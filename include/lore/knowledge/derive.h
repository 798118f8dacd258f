#pragma once

#include <lore/knowledge/knowledge_base.h>

namespace lore {

/// Knowledge bases made from knowledge bases. Each returns a new one, its provenance naming the sources.

/// "KB random": values uniform between the smallest and the largest value of `base`.
KnowledgeBase randomize(KnowledgeBase const& base, std::uint64_t seed);
/// The `count` features of highest value (ties: the lower number), in their old order.
KnowledgeBase keep_top(KnowledgeBase const& base, int count);
KnowledgeBase keep_valued(KnowledgeBase const& base, double least_value);
/// The features of `base` that match some feature in every one of `others` (paper, Conclusion: future work).
KnowledgeBase keep_consensus(KnowledgeBase const& base, std::span<KnowledgeBase const> others);

} // namespace lore
