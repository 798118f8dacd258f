#pragma once

#include <lore/archive/container.h>

#include <optional>
#include <span>

namespace lore {

/// Whether these bytes begin a zstd frame that says it unpacks to `raw_length` bytes, and could: the format's densest
/// block makes 128 KiB of 4 bytes, so that a few forged bytes cannot ask for gigabytes. Allocates nothing.
bool may_unpack_to(std::span<std::byte const> packed, std::uint64_t raw_length);

/// Nothing where the frame does not unpack to just that many bytes.
std::optional<Bytes> unpack_frame(std::span<std::byte const> packed, std::uint64_t raw_length);

}   // namespace lore
