#include <lore/core/directory.h>

#include <lore/core/file.h>

#include <system_error>

namespace lore {

namespace fs = std::filesystem;

namespace {

void check(std::error_code const& failed, std::string const& path) {
    if (failed) throw file_error("read", path, failed.value());
}

}   // namespace

std::vector<DirectoryEntry> entries_in(std::string const& directory) {
    std::vector<DirectoryEntry> entries;
    std::error_code failed;
    for (fs::directory_iterator at{directory, failed}, end; !failed && at != end; at.increment(failed)) {
        std::error_code unknown;
        fs::file_type const type = at->symlink_status(unknown).type();
        if (type == fs::file_type::not_found) continue;
        check(unknown, at->path().string());
        entries.push_back({at->path().string(), type});
    }
    check(failed, directory);
    return entries;
}

std::vector<DirectoryEntry> entries_below(std::string const& directory) {
    std::vector<DirectoryEntry> entries = entries_in(directory);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i].type != fs::file_type::directory) continue;
        std::vector<DirectoryEntry> const below = entries_in(entries[i].path);
        entries.insert(entries.end(), below.begin(), below.end());
    }
    return entries;
}

void remove_file(std::string const& path) {
    std::error_code failed;
    fs::remove(path, failed);
    if (failed) throw file_error("remove", path, failed.value());
}

}   // namespace lore
