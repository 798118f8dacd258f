#pragma once

#include "work_order.h"

#include <cstdint>
#include <string_view>

namespace lore {

/// All that the results of a run depend on, in one number: the settings that affect results (result_settings), the
/// arena, the knowledge base, the seed and, where founders are not random, the checksums of their files. A checkpoint
/// keeps it, and is only continued where it is the same.
std::uint64_t digest_of(WorkOrder const&, std::uint64_t seed, std::string_view founders_checksum = "");

/// The digest of checkpoints that were written up to commit e8a0ef9: over the configuration as it was rendered then,
/// descriptions included. `config_text` is the run's own config.toml, because no other file still has that text.
std::uint64_t former_digest_of(std::string_view config_text, WorkOrder const&, std::uint64_t seed);

}   // namespace lore
