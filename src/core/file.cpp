#include <lore/core/file.h>

#include <lore/core/standard_streams.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

namespace lore {

namespace fs = std::filesystem;

namespace {

std::string_view remedy_for(int error_number) {
    switch (error_number) {
    case ENOSPC:
    case EDQUOT: return "Free some space and run again (a run: with --resume).";
    case EFBIG: return "Raise the limit on file sizes (ulimit -f) and run again.";
    case EACCES:
    case EPERM:
    case EROFS: return "Choose a place where you may write, or change its permissions.";
    case ENOENT:
    case ENOTDIR:
    case ENAMETOOLONG:
    case ELOOP: return "Check the path.";
    default: return "Check the disk.";
    }
}

}   // namespace

bool FileDescriptor::close() { return number_ < 0 || ::close(release()) == 0; }

Error file_error(std::string_view verb, std::string const& path, int error_number) {
    return Error(fmt::format("cannot {} {}", verb, path), std::strerror(error_number), remedy_for(error_number));
}

void write_fully(int descriptor, std::span<std::byte const> content, std::string const& path) {
    while (!content.empty()) {
        ssize_t const written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw file_error("write", path, errno);
        content = content.subspan(static_cast<std::size_t>(written));
    }
}

void sync_file(int descriptor, std::string const& path) {
    // EINVAL: a file system or a device that knows no fsync; nothing is lost by not calling it there.
    if (::fsync(descriptor) != 0 && errno != EINVAL) throw file_error("write", path, errno);
}

bool is_there(std::string const& path) {
    std::error_code failed;
    bool const there = fs::exists(path, failed);
    if (failed) throw file_error("look at", path, failed.value());
    return there;
}

void make_directory(std::string const& path) {
    std::error_code failed;
    fs::create_directories(path, failed);
    if (failed || !fs::is_directory(path, failed))
        throw Error(fmt::format("cannot make the directory {}", path),
                    failed ? failed.message() : "there is a file of that name", "Choose another place for it.");
}

std::string current_path(std::string const& path) {
    fs::path const former{path}, folder = former.parent_path(), name = former.filename();
    std::error_code ignored;
    if (former.extension() != ".toml" || fs::exists(former, ignored)) return path;
    std::vector<fs::path> found;
    for (fs::path const& place : {folder / "tasks" / name, folder / "campaigns" / name})
        if (fs::is_regular_file(place, ignored)) found.push_back(place);
    if (fs::path const place = folder.parent_path() / "tasks" / "arenas" / name;
        folder.filename() == "arenas" && fs::is_regular_file(place, ignored))
        found.push_back(place);
    if (found.size() != 1) return path;
    static std::set<std::string> told;
    if (told.insert(path).second)
        write_stderr(fmt::format("{} has moved to {}; the old name works in every 1.x, not in 2.\n", path,
                                 found.front().string()));
    return found.front().string();
}

}   // namespace lore
