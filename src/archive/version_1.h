#pragma once

#include <lore/archive/world_record.h>
#include <lore/behavior/descriptors.h>

namespace lore {

class InArchive;

/// Files of format version 1 (and knowledge bases of layouts 1 and 2) are of collectball and do not say so: its
/// channels and its unit of reward are all that is known of their world.
WorldRecord const& world_of_version_1();

/// Descriptors as version 1 has them: positions in pairs, and entropies without a count.
void get_descriptors_of_version_1(InArchive&, Descriptors&);

}   // namespace lore
