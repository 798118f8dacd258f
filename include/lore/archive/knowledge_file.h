#pragma once

#include <lore/archive/world_record.h>
#include <lore/knowledge/knowledge_base.h>

#include <string>
#include <vector>

namespace lore {

/// A KB file is a plain container whose payload holds the arrays as they are used, each aligned to 64 bytes of the
/// file, so that the ranks of one node map it and share it through the page cache. docs/manual/formats.md has the
/// layout.

/// Atomic; throws Error (full disk, no permission), the former file survives.
void write_knowledge_base(std::string const& path, KnowledgeBase const&);
/// Maps the file and checks it whole: header, lengths, checksum, and that every number is finite and in its range.
/// Throws Error. The knowledge base keeps the mapping alive.
KnowledgeBase read_knowledge_base(std::string const& path);
/// Bases that are used together. Throws as read_knowledge_base, and UsageError unless all have windows of one length.
std::vector<KnowledgeBase> read_knowledge_bases(std::vector<std::string> const& paths);
/// Before windows of a world with these channels are looked up in the base from `path`. Throws UsageError if it has
/// others.
void require_channels(KnowledgeBase const&, std::string const& path, Channels const&);
/// What a base knows of its world: the channels and the unit of the reward.
WorldRecord world_record(KnowledgeBase const&);

}   // namespace lore
