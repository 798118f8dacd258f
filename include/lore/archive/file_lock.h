#pragma once

#include <lore/core/file.h>

#include <optional>
#include <string>
#include <utility>

namespace lore {

/// An exclusive right, represented by a lock file: of all processes that share its directory, one has it at a time.
///
/// A lock of the open file (Linux's OFD locks), so that a started program can inherit it: if the process that took it
/// is killed while that program goes on, it stays taken until that ends too.
class FileLock {
public:
    /// Makes the file, and its directory, where they are missing. Nothing if another process has the lock; throws Error
    /// where the file cannot be made, or its file system knows no locks.
    static std::optional<FileLock> take(std::string const& path);
    /// Only looks: makes nothing, and needs no permission to write. False where the file cannot be read.
    static bool is_taken(std::string const& path);
    int descriptor() const { return file_.get(); }

private:
    explicit FileLock(FileDescriptor file) : file_(std::move(file)) {}
    FileDescriptor file_;
};

}   // namespace lore
