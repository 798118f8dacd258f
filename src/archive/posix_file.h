#pragma once

#include <lore/core/file.h>

#include <string>
#include <string_view>

#include <unistd.h>

namespace lore {

void sync_file(int descriptor, std::string const& path);
/// Makes a rename or a new name in it durable.
void sync_directory_of(std::string const& path);

}   // namespace lore
