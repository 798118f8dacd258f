#pragma once

#include "treatment_inputs.h"

#include <lore/campaign/plan.h>
#include <lore/core/toml.h>

#include <optional>

namespace lore {

/// The table [transfer]: by which use of knowledge every source task is to help every target task.
struct TransferRequest {
    TomlTable table;
    TreatmentInput const* method = nullptr;
    int run = 0;   ///< of each source task, whose lineage the bases come from; 0: the one with most reward
    int top = 0;   ///< so many features of greatest value; 0: all
};

/// Nothing if there is no such table. Precondition: sources and target tasks have been read. Throws UsageError.
std::optional<TransferRequest> read_transfer(TomlTable const& document, CampaignPlan const&);

/// Adds, for each source task, the base NAME from a lineage, and NAME_best of its best features where so many are
/// asked for. Throws UsageError.
void add_transfer_bases(TransferRequest const&, CampaignPlan&);

/// Adds the treatments TARGET_from_none and TARGET_from_SOURCE, and the pairs that they make. Worlds are opened to see
/// which pairs fit; one that cannot be opened fits, until check_worlds says why it cannot. Throws UsageError.
void add_transfer_treatments(TransferRequest const&, CampaignPlan&);

}   // namespace lore
