#pragma once

#include <lore/campaign/plan.h>
#include <lore/campaign/steps.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

class TomlTable;

/// Where the command lines of a campaign find things.
struct CommandContext {
    CampaignPlan const& plan;
    CampaignDirectory const& directory;
    Choice const* choice = nullptr;   ///< of source runs; null as long as none is made
};

/// What sets one kind of knowledge base apart. A new kind is a word of KnowledgeKind, one row of the table in
/// knowledge_kinds.cpp, and the functions that the row names; nothing else asks which kinds there are.
struct KnowledgeKindRow {
    std::string_view key;   ///< of [[knowledge]], whose presence says that it is this kind
    KnowledgeKind kind;
    bool is_built;           ///< Algorithm 1 makes it, so that it has windows of its own; else it has its base's
    bool base_has_lineage;   ///< the key names a knowledge base with a wished reward or 'run'
    void (*read)(TomlTable const&, KnowledgePlan&);   ///< its keys, apart from those that all kinds have
    /// Adds the steps that this base alone needs before its own, and returns the groups that its own waits for.
    std::vector<std::string> (*prepare)(KnowledgePlan const&, std::vector<Step>&);
    /// Of lore-kb, from the subcommand on; options that all kinds have and --out follow.
    std::vector<std::string> (*arguments)(KnowledgePlan const&, CommandContext const&);
};

std::span<KnowledgeKindRow const> knowledge_kinds();
/// Lineage has four rows, which differ in how they are read.
KnowledgeKindRow const& row_of(KnowledgeKind);

/// KnowledgePlan::run of a table that stands for a base of each source run.
inline constexpr int each_run = -1;

/// One [[knowledge]] table. Other bases and the source that it names are not looked at. Throws UsageError.
KnowledgePlan read_knowledge(TomlTable const&);

/// The directory of the source run that a base with a wished reward or 'run' comes from; "?" for its number until it is
/// chosen.
std::string source_run_of(KnowledgePlan const& lineage, CommandContext const&);

/// "knowledge/kb1" and "archive/kb1_all".
std::string knowledge_step(std::string_view name);
std::string archive_step(std::string_view name);

}   // namespace lore
