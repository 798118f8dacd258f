#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Writes a whole file or nothing: temporary file beside it, fsync, rename, fsync of the directory. Throws Error (full
/// disk, no permission, directory gone); the former file survives.
void write_file_atomically(std::string const& path, std::span<std::byte const> content);
void write_file_atomically(std::string const& path, std::string_view content);

/// A whole file. Throws Error (missing, unreadable, a directory).
std::vector<std::byte> read_file(std::string const& path);

/// Temporary files that a killed process left in `directory` are removed; no other process may be writing there.
void remove_leftovers(std::string const& directory);

} // namespace lore
