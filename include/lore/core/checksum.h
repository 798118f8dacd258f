#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lore {

/// XXH3-64: finds accidents, not malice.
std::uint64_t checksum(std::span<std::byte const>);
std::uint64_t checksum(std::string_view);
/// Of a whole file. Throws Error.
std::uint64_t checksum_of_file(std::string const& path);
/// 16 lower-case hexadecimal digits.
std::string checksum_text(std::uint64_t);

}   // namespace lore
