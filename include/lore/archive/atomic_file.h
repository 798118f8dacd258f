#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Writes a whole file or nothing: temporary file beside it, fsync, rename, fsync of the directory. Throws Error (full
/// disk, no permission, directory gone); the former file survives. A symbolic link stays one, and the file that it
/// leads to is written.
void write_file_atomically(std::string const& path, std::span<std::byte const> content);
void write_file_atomically(std::string const& path, std::string_view content);
/// Throws UsageError if there is a pipe or a device at `path`: a file would take its place. Writing asks, too.
void refuse_pipe_or_device(std::string const& path);
/// Pieces one after the other, for content that would not fit into memory twice.
using BytePieces = std::span<std::span<std::byte const> const>;
void write_file_atomically(std::string const& path, BytePieces content);

/// Likewise, but what `path` held stays as `former`, in place of what that held. Nothing is touched before the new
/// content is on the disk whole; killed at the worst moment, a process leaves `former` alone, for lack of a `path`.
void replace_file(std::string const& path, std::string const& former, std::span<std::byte const> content);

/// A whole file, as read_bytes reads it: in bounds, and without waiting for ever. Throws Error.
std::vector<std::byte> read_file(std::string const& path);

/// Temporary files that a killed process left in `directory` are removed; no other process may be writing there.
void remove_leftovers(std::string const& directory);

}   // namespace lore
