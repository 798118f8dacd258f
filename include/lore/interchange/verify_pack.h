#pragma once

#include <lore/interchange/pack.h>

#include <string>
#include <vector>

namespace lore {

/// What a look at a packed campaign has found.
struct PackVerdict {
    std::string title;
    std::size_t files = 0, left_out = 0;   ///< described as there, and as left out
    std::vector<std::string> defects;      ///< a line each; none: it is whole
};

/// Checks a packed campaign, an archive or a directory: it is described as RO-Crate wants it, every file is there with
/// its length and SHA-256, nothing is there besides, and every file of Lore can be read (as `lore-kb verify` does).
///
/// An archive is not trusted: names that lead out of it, links and special files are defects and are not followed, and
/// what is described is unpacked into a directory of temporary files only once its checksum is right. Throws UsageError
/// for a name that is none, Error where the archive cannot be read to its end.
PackVerdict verify_pack(
    std::string const& path, Pulse const& = [] {});

}   // namespace lore
