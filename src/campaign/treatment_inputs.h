#pragma once

#include "knowledge_kinds.h"

#include <lore/campaign/plan.h>
#include <lore/experiment/config.h>
#include <lore/experiment/manifest.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Something that the runs of a treatment take from other steps of the campaign, named by one key of [[treatment]].
/// A new input is a member of Treatment, one row of the table in treatment_inputs.cpp, and the functions that the row
/// names; nothing else asks which inputs there are.
struct TreatmentInput {
    std::string_view key;
    std::string_view method;                      ///< what [transfer] calls it
    std::vector<std::string> Treatment::*names;   ///< of the bases that the key names; none: it does without
    /// Throws UsageError if the campaign, as read so far, has nothing of that name or nothing that fits; may add
    /// overrides to the treatment.
    void (*fit)(TomlTable const&, CampaignPlan const&, Treatment&);
    /// Adds the steps that this treatment alone needs before its runs, and returns the groups that the runs wait for.
    std::vector<std::string> (*prepare)(CampaignPlan const&, Treatment const&, std::vector<Step>&);
    /// Of lore-evolve, after all others.
    std::vector<std::string> (*arguments)(Treatment const&, CommandContext const&);
    std::string_view role;   ///< in the manifests of the runs, of the files that the arguments name: a file_role
};

std::span<TreatmentInput const> treatment_inputs();

/// In what the files that a finished run read from other steps are not those of its treatment, in a few words; empty if
/// they are. Directories of campaigns may have moved: only the ends of paths count. `founders_from`: of its
/// configuration, which may name founders that come from no step.
std::string other_inputs(Treatment const&, CommandContext const&, std::vector<std::string> const& founders_from,
                         Manifest const&);

/// Adds a target treatment to the campaign as read so far, the members of a family in the place of its name. Throws
/// UsageError, which names the table: a name that is taken, or an input that does not fit.
void add_treatment(TomlTable const&, Treatment, CampaignPlan&);

/// Knowledge settings of a treatment's configuration with these overrides. Throws UsageError, which names the
/// campaign's file, for a mistake in the configuration.
KnowledgeConfig read_windows(TomlTable const&, std::string const& config_path,
                             std::vector<std::string> const& overrides);

}   // namespace lore
