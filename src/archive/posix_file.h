#pragma once

#include <lore/core/error.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <unistd.h>

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
    bool close() { return number_ < 0 || ::close(release()) == 0; }

private:
    int number_;
};

/// An Error from errno: "cannot `verb` `path` (reason). remedy".
Error file_error(std::string_view verb, std::string const& path, int error_number);

/// All of it, whatever the kernel takes at a time. Throws file_error("write", path).
void write_fully(int descriptor, std::span<std::byte const> content, std::string const& path);
void sync_file(int descriptor, std::string const& path);
/// Makes a rename or a new name in it durable.
void sync_directory_of(std::string const& path);

}   // namespace lore
