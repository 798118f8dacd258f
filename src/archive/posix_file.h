#pragma once

#include <lore/core/file.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <unistd.h>

namespace lore {

/// All of it, whatever the kernel takes at a time. Throws file_error("write", path).
void write_fully(int descriptor, std::span<std::byte const> content, std::string const& path);
void sync_file(int descriptor, std::string const& path);
/// Makes a rename or a new name in it durable.
void sync_directory_of(std::string const& path);

}   // namespace lore
