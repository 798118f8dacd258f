#pragma once

#include <lore/knowledge/knowledge_base.h>

#include <string>

namespace lore {

/// A KB file holds the arrays as they are used, so that the ranks of one node map it and share it through the page cache.
void write_knowledge_base(std::string const& path, KnowledgeBase const&);
/// Maps the file and checks it whole (header, lengths, checksum, finite values). Throws Error.
KnowledgeBase read_knowledge_base(std::string const& path);

} // namespace lore
