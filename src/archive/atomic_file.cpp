#include <lore/archive/atomic_file.h>

#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace lore {

namespace {

constexpr std::string_view temporary_mark = ".lore-tmp-";

std::string directory_of(std::string const& path) {
    std::string const directory = std::filesystem::path{path}.parent_path().string();
    return directory.empty() ? "." : directory;
}

/// The file that a symbolic link leads to, if it is one.
std::string behind_links(std::string const& path) {
    std::error_code failed;
    if (!std::filesystem::is_symlink(path, failed)) return path;
    std::filesystem::path const target = std::filesystem::weakly_canonical(path, failed);
    return failed ? path : target.string();
}

/// Removes the temporary file unless the rename has happened.
struct Temporary {
    std::string path;
    bool kept = false;
    ~Temporary() {
        if (!kept) ::unlink(path.c_str());
    }
};

std::string name_beside(std::string const& path) { return fmt::format("{}{}{}", path, temporary_mark, ::getpid()); }

/// Of a large file each part is on its way to the disk while the next is written.
void write_in_parts(FileDescriptor const& file, std::span<std::byte const> content, std::string const& path) {
    constexpr std::size_t part = std::size_t{16} << 20;
    for (; content.size() > part; content = content.subspan(part)) {
        write_fully(file.get(), content.first(part), path);
        off_t const end = ::lseek(file.get(), 0, SEEK_CUR);
        ::sync_file_range(file.get(), end - static_cast<off_t>(part), part, SYNC_FILE_RANGE_WRITE);   // a wish
    }
    write_fully(file.get(), content, path);
}

/// Makes a rename or a new name in it durable.
void sync_directory_of(std::string const& path) {
    std::string const directory = directory_of(path);
    FileDescriptor const opened{::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (opened.get() < 0) throw file_error("write", path, errno);
    sync_file(opened.get(), path);
}

/// `path` is what errors call it.
void write_durably(std::string const& temporary, BytePieces content, std::string const& path) {
    FileDescriptor file{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (file.get() < 0) throw file_error("write", path, errno);
    for (std::span<std::byte const> const piece : content) write_in_parts(file, piece, path);
    sync_file(file.get(), path);
    if (!file.close()) throw file_error("write", path, errno);
}

}   // namespace

void write_file_atomically(std::string const& path, std::span<std::byte const> content) {
    write_file_atomically(path, BytePieces{&content, 1});
}

void refuse_pipe_or_device(std::string const& path) {
    std::error_code ignored;
    auto const status = std::filesystem::status(path, ignored);
    if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status) ||
        std::filesystem::is_directory(status))
        return;
    throw UsageError(fmt::format("cannot write {}", path),
                     "it is a pipe or a device, and files are replaced as a whole", "Name a file.");
}

void write_file_atomically(std::string const& wanted, BytePieces content) {
    refuse_pipe_or_device(wanted);
    std::string const path = behind_links(wanted);
    Temporary temporary{name_beside(path)};
    write_durably(temporary.path, content, path);
    if (::rename(temporary.path.c_str(), path.c_str()) != 0) throw file_error("write", path, errno);
    temporary.kept = true;
    sync_directory_of(path);
}

void replace_file(std::string const& path, std::string const& former, std::span<std::byte const> content) {
    Temporary temporary{name_beside(path)};
    write_durably(temporary.path, BytePieces{&content, 1}, path);
    if (::rename(path.c_str(), former.c_str()) != 0 && errno != ENOENT) throw file_error("write", former, errno);
    if (::rename(temporary.path.c_str(), path.c_str()) != 0) throw file_error("write", path, errno);
    temporary.kept = true;
    sync_directory_of(path);
}

void write_file_atomically(std::string const& path, std::string_view content) {
    write_file_atomically(path, std::as_bytes(std::span{content.data(), content.size()}));
}

std::vector<std::byte> read_file(std::string const& path) { return read_bytes(path); }

void remove_leftovers(std::string const& directory) {
    std::error_code ignored;
    for (std::filesystem::directory_iterator at{directory, ignored}, end; !ignored && at != end; at.increment(ignored))
        if (at->path().filename().string().find(temporary_mark) != std::string::npos) {
            std::error_code kept;
            std::filesystem::remove(at->path(), kept);
        }
}

}   // namespace lore
