#pragma once

#include <lore/campaign/plan.h>
#include <lore/core/toml.h>

namespace lore {

/// Adds a base to the campaign as read so far: finds its source task, and has the base that it is revalued from gather
/// evidence. Throws UsageError, which names the table: a name that is taken, or that of nothing before it; a run that
/// there is not; evidence that no build gathers.
void add_knowledge(TomlTable const&, KnowledgePlan, CampaignPlan&);

/// All [[knowledge]] tables, families as their members. Throws UsageError, also where a source task has fewer runs than
/// bases.
void read_knowledge_bases(TomlTable const& document, CampaignPlan&);

}   // namespace lore
