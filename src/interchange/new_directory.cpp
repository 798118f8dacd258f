#include "new_directory.h"

#include <lore/core/error.h>
#include <lore/core/file.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace lore {

namespace fs = std::filesystem;

NewDirectory::NewDirectory(std::string name) : name_(std::move(name)) {
    while (name_.size() > 1 && name_.ends_with('/')) name_.pop_back();
    if (fs::symlink_status(name_).type() != fs::file_type::not_found)
        throw UsageError(fmt::format("cannot write {}", name_), "it exists", "Choose another name, or move it away.");
    path_ = fmt::format("{}.lore-tmp-{}", name_, ::getpid());
    make_directory(path_);
}

NewDirectory::~NewDirectory() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
}

void NewDirectory::keep() {
    rename_without_replacing(path_, name_);
    kept_ = true;
}

void rename_without_replacing(std::string const& from, std::string const& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
    if (errno != EINVAL && errno != ENOSYS) throw file_error("write", to, errno);
    // Some network file systems do not know the flag.
    if (fs::symlink_status(to).type() != fs::file_type::not_found) throw file_error("write", to, EEXIST);
    if (::rename(from.c_str(), to.c_str()) != 0) throw file_error("write", to, errno);
}

}   // namespace lore
