#pragma once

#include "sha256.h"

#include <lore/campaign/steps.h>
#include <lore/interchange/pack.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Names of what a pack adds to a campaign's directory.
inline constexpr std::string_view crate_file = "ro-crate-metadata.json", sums_file = "SHA256SUMS",
                                  inputs_folder = "inputs/";

/// A file of a pack, or one that is left out.
struct PackedFile {
    std::string path;     ///< in the pack, with '/' and without "." and ".."
    std::string source;   ///< where it is read
    std::uint64_t bytes = 0;
    std::string sha256;
    bool executable = false;   ///< of inputs: a world's process may be a program of its own
};

struct Inventory {
    std::vector<PackedFile> files, left_out;   ///< by path
};

/// Whether the file is there only while something is at work: locks, temporary files.
bool is_transient(std::string_view path);

/// A relative path without ".", ".." and empty steps, of UTF-8 without control characters: the same in every archive,
/// and never one that leads out of it.
bool is_safe_path(std::string_view path);

/// The part that a file belongs to, if any.
std::optional<PackPart> part_of(std::string_view path);

/// Everything that belongs to the campaign, with its sum. Throws Error: a link, a special file, a name that is no UTF-8
/// or has control characters.
Inventory take_inventory(CampaignPlan const&, CampaignDirectory const&, std::vector<PackPart> const& leave_out,
                         BetweenPieces const&);

/// The campaign as it is found in the pack: its file, its configurations and the files of its worlds below inputs/, in
/// the same places to each other.
CampaignPlan plan_in_pack(CampaignPlan const&);

/// Where the pack has the files that the treatments' worlds are made of (world_files), by the treatment's name.
std::map<std::string, std::vector<std::string>> places_of_worlds(CampaignPlan const&);

/// The lines of SHA256SUMS, as sha256sum writes them.
std::string sums_text(std::vector<PackedFile> const&);

}   // namespace lore
