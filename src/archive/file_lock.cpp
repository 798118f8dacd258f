#include <lore/archive/file_lock.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>

namespace lore {

namespace {

struct flock whole_file() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

}   // namespace

std::optional<FileLock> FileLock::take(std::string const& path) {
    if (auto const directory = std::filesystem::path{path}.parent_path(); !directory.empty())
        make_directory(directory.string());
    FileDescriptor file{::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)};
    if (file.get() < 0) throw file_error("write", path, errno);
    struct flock lock = whole_file();
    if (::fcntl(file.get(), F_OFD_SETLK, &lock) == 0) return FileLock{std::move(file)};
    if (errno == EAGAIN || errno == EACCES) return std::nullopt;
    throw Error(fmt::format("cannot lock {}", path), std::strerror(errno),
                "Choose a directory on a file system with locks.");
}

bool FileLock::is_taken(std::string const& path) {
    // To read is enough for a look: also of who may not write there.
    FileDescriptor const file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.get() < 0) return false;
    struct flock lock = whole_file();
    return ::fcntl(file.get(), F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

}   // namespace lore
