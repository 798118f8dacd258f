#pragma once

#include <lore/core/error.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lore {

/// An open file descriptor that closes itself.
class FileDescriptor {
public:
    explicit FileDescriptor(int number = -1) : number_(number) {}
    FileDescriptor(FileDescriptor&& other) noexcept : number_(other.release()) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        if (this != &other) {
            close();
            number_ = other.release();
        }
        return *this;
    }
    ~FileDescriptor() { close(); }
    int get() const { return number_; }
    int release() {
        int const number = number_;
        number_ = -1;
        return number;
    }
    /// False where the kernel reports a late write error.
    bool close();

private:
    int number_;
};

/// An Error from errno: "cannot `verb` `path` (reason). remedy".
Error file_error(std::string_view verb, std::string const& path, int error_number);

/// All of it, whatever the kernel takes at a time. Throws file_error("write", path).
void write_fully(int descriptor, std::span<std::byte const> content, std::string const& path);

/// What was written is on the disk when it returns. Throws file_error("write", path).
void sync_file(int descriptor, std::string const& path);

/// Whether a file, a directory or anything else has this name. Throws Error where that cannot be told, such as without
/// permission to look.
bool is_there(std::string const& path);

/// Makes a directory and those above it; one that is there is left as it is. Throws Error: no permission, or a file has
/// that name.
void make_directory(std::string const& path);

/// For this version only: files below jobs/ have moved. Where jobs/NAME.toml is missing and exactly one of
/// jobs/tasks/NAME.toml and jobs/campaigns/NAME.toml is there (for jobs/arenas/NAME.toml: jobs/tasks/arenas/NAME.toml),
/// that one, and a line on stderr says so, once a program; any other path as it is.
std::string current_path(std::string const& path);

}   // namespace lore
