#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lore {

/// A file as a crate describes it.
struct DescribedFile {
    std::string path;
    std::optional<std::uint64_t> bytes;
    std::string sha256;   ///< empty: not told
};

/// What ro-crate-metadata.json says of files, and what is wrong with it.
struct CrateDescription {
    std::string title;
    std::vector<DescribedFile> files, left_out;
    std::vector<std::string> defects;   ///< a line each
};

/// From the text of ro-crate-metadata.json, whatever it is. Files on the web are left alone.
CrateDescription read_crate(std::string const& text);

}   // namespace lore
