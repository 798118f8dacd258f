#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lore {

/// Something that lies in a directory.
struct DirectoryEntry {
    std::string path;   ///< begins with the directory's as it was given
    std::filesystem::file_type type = std::filesystem::file_type::none;   ///< of itself: links are not followed
};

/// What lies in a directory, in no order. What goes away meanwhile is left out. Throws Error where it cannot be read.
std::vector<DirectoryEntry> entries_in(std::string const& directory);
/// Likewise, with all that lies below it; not through links.
std::vector<DirectoryEntry> entries_below(std::string const& directory);

/// Throws Error where there is such a file and it cannot be removed.
void remove_file(std::string const& path);

}   // namespace lore
