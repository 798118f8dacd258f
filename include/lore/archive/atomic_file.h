#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lore {

/// Writes a whole file or nothing: temporary file beside it, fsync, rename, fsync of the directory. Throws Error (full
/// disk, no permission, directory gone); the former file survives.
void write_file_atomically(std::string const& path, std::span<std::byte const> content);
void write_file_atomically(std::string const& path, std::string_view content);

} // namespace lore
