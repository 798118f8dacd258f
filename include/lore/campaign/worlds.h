#pragma once

#include <lore/campaign/plan.h>

namespace lore {

/// Opens the world of every treatment, so that a mistake shows before the first run. Throws UsageError, which names the
/// treatment: its world cannot be opened, or a treatment takes knowledge or founders from a source task whose channels
/// are others.
void check_worlds(CampaignPlan const&);

}   // namespace lore
