#pragma once

#include "sha256.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace lore {

/// Whether the name ends with .tar.zst, .tar.gz or .zip.
bool is_archive_name(std::string const& path);

/// Writes an archive in which nothing but names and contents of files differs from another: no owners, one time, one
/// mode but for programs. It is written under another name and gets its own in the end; without close() it goes away.
/// The door of libarchive, with ArchiveReader.
class ArchiveWriter {
public:
    /// Throws UsageError: the name has another ending, or something has it.
    explicit ArchiveWriter(std::string path);
    ~ArchiveWriter();
    ArchiveWriter(ArchiveWriter const&) = delete;
    ArchiveWriter& operator=(ArchiveWriter const&) = delete;

    /// A file begins, of this length; its bytes follow. Throws Error.
    void begin(std::string const& name, std::uint64_t bytes, bool executable = false);
    void write(std::span<std::byte const>);
    /// All of it is on the disk under its own name. Throws Error, also if somebody has taken the name meanwhile.
    void close();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// One entry of an archive; its bytes can be read once, before the next.
struct ArchiveEntry {
    std::string name;       ///< as the archive has it: anything; empty: none that is UTF-8
    std::string kind;       ///< "file", "directory", "link", "special file"
    bool is_file = false;   ///< a regular one
    std::function<void(std::function<void(std::span<std::byte const>)> const& use)> read;   ///< throws Error
};

/// Calls `look` for each entry of a tar archive (plain, zstd, gzip, xz or bzip2) or zip. Throws UsageError for a name
/// that is none, Error where it is no such archive, or cannot be read to its end.
void for_each_entry(std::string const& path, BetweenPieces const& between,
                    std::function<void(ArchiveEntry const&)> const& look);

}   // namespace lore
