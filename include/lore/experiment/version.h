#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lore {

/// What this build is made of; the same for --version and for the manifest.
struct BuildInformation {
    std::string version;   ///< of Lore
    std::string commit;    ///< of the source, "unknown" if it was not configured in a clone
    std::string compiler;
    std::string build_type;
    std::vector<std::pair<std::string, std::string>> libraries;   ///< name, version
};
BuildInformation build_information();

/// What --version prints: program, version, commit, compiler, instruction set in use, libraries.
std::string version_text(std::string_view program);

}   // namespace lore
