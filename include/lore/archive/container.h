#pragma once

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

using Bytes = std::vector<std::byte>;

/// Kinds of files Lore writes in containers; the number is in the file.
enum class FileKind : std::uint32_t {
    lineage = 1,
    checkpoint = 2,
    knowledge_base = 3,
    all_individuals = 4,
    genome = 5,
    founders = 6
};
std::string_view name(FileKind);

/// The format that this build writes, and the newest that it reads. Every older one stays readable. 1: files of
/// collectball, which do not name their world.
inline constexpr std::uint32_t container_version = 2;
/// A payload starts at this offset of its file, so that arrays of a mapped payload are aligned like their file.
inline constexpr std::size_t container_header_size = 64;

/// How the payload is stored: compressed by zstd with care, or fast (what is soon replaced); plain if it is to be
/// mapped.
enum class Packing : std::uint8_t { compressed, fast, plain };

/// Every binary file of Lore: magic, format version, kind, byte order, payload length, flags and checksum (XXH3-64) in
/// front of a payload that is zstd-compressed where that pays. All of it is checked before anyone parses the payload;
/// lengths in the header are checked against the file before anything is allocated. docs/manual/formats.md has the
/// layout.
///
/// What is compressed is at most 4 GiB: readers refuse more, and writing it throws Error.
///
/// Writing is atomic: temporary file in the same directory, fsync, rename, fsync of the directory. On any failure the
/// former file is still there, whole.
void write_container(std::string const& path, FileKind, std::span<std::byte const> payload,
                     Packing = Packing::compressed);
/// A plain one, to be mapped; in pieces, because a knowledge base of all individuals would not fit into memory twice.
void write_plain_container(std::string const& path, FileKind, BytePieces payload);
/// Of a file that a newer Lore wrote: it may be whole, but this build cannot tell.
struct NewerFormat : Error {
    using Error::Error;
};
struct Payload {
    Bytes bytes;
    std::uint32_t version = container_version;   ///< of the format in which they are laid out
};
/// Throws Error: missing, cut, changed, not Lore's, or of another kind; NewerFormat.
Payload read_container(std::string const& path, FileKind expected);
/// The same on bytes in memory, for tests and fuzzing; `name` is what errors call them.
Bytes seal(FileKind, std::span<std::byte const> payload, Packing = Packing::compressed);
Payload unseal(std::span<std::byte const> file, FileKind expected, std::string_view name);
/// Length of the container that begins with this header, the header included. Throws Error.
std::uint64_t container_length(std::span<std::byte const> header, std::string_view name);

/// The payload of a checked file. Of a plain one it is the mapped file itself, shared through the page cache by all
/// processes of a node; of a compressed one a private copy. Valid as long as keep_alive.
struct MappedPayload {
    std::span<std::byte const> bytes;
    std::shared_ptr<void const> keep_alive;
};
MappedPayload map_container(std::string const& path, FileKind expected);

/// What the header of a file says of its kind; for `lore-kb verify`. Throws Error if it is none of Lore's.
FileKind kind_of_file(std::string const& path);

}   // namespace lore
