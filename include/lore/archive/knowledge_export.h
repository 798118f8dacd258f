#pragma once

#include <lore/knowledge/knowledge_base.h>

#include <string>

namespace lore {

/// Knowledge bases and windows for the long term and for other programs (docs/manual/formats.md has columns and
/// shapes).

/// A row a feature: feature, value, reward_sum, count, then each channel of each step by its name (NAME_0 .. NAME_19),
/// then the evidence that there is.
std::string knowledge_csv(KnowledgeBase const&);
/// features.npy (n, T, channels), values.npy, reward_sums.npy, counts.npy, the evidence and provenance.json into a
/// directory, which is made if need be. Throws Error.
void export_knowledge(std::string const& directory, KnowledgeBase const&);
/// What a knowledge base knows of its origin and, as `world`, of its world: as its file holds it.
std::string provenance_json(KnowledgeBase const&);
/// The same without the world.
std::string provenance_json(Provenance const&);

/// Windows from an NPY file of shape (n, T, C) or (n, C T), C channels, one after the other as the steps of a trace
/// without positions. Throws Error if the shape is another, or a binary channel is neither 0 nor 1.
Trace read_windows(std::string const& path, KnowledgeConfig const&);

}   // namespace lore
