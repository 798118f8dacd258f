#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

using Bytes = std::vector<std::byte>;

/// Kinds of files Lore writes in containers; the number is in the file.
enum class FileKind : std::uint32_t { lineage = 1, checkpoint = 2, knowledge_base = 3, all_individuals = 4, genome = 5 };

/// Every binary file of Lore: magic, format version, kind, byte order, payload length, flags and checksum (XXH3-64) in
/// front of a payload that is zstd-compressed where that pays. All of it is checked before anyone parses the payload;
/// lengths in the header are checked against the file before anything is allocated. docs/formats.md has the layout.
///
/// Writing is atomic: temporary file in the same directory, fsync, rename, fsync of the directory. On any failure the
/// former file is still there, whole.
void write_container(std::string const& path, FileKind, std::span<std::byte const> payload);
/// Throws Error: missing, cut, changed, not Lore's, of another kind, or of a newer version.
Bytes read_container(std::string const& path, FileKind expected);
/// The same on bytes in memory, for tests and fuzzing; `name` is what errors call them.
Bytes seal(FileKind, std::span<std::byte const> payload);
Bytes unseal(std::span<std::byte const> file, FileKind expected, std::string_view name);

} // namespace lore
