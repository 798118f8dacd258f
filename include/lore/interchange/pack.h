#pragma once

#include <lore/campaign/steps.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lore {

/// Parts of a campaign's directory that a pack may do without, most of its bytes.
enum class PackPart : std::uint8_t {
    individuals,   ///< archives of all individuals
    checkpoints,   ///< what runs continue from
    bases,         ///< knowledge bases
    logs           ///< output of the steps
};
std::string_view name(PackPart);
/// Throws UsageError.
PackPart pack_part(std::string_view name);

/// What the user says of a pack; all of it optional.
struct PackOptions {
    std::vector<PackPart> leave_out;
    std::string license;                ///< of the data: an SPDX identifier, a URL, or a sentence
    std::vector<std::string> authors;   ///< "Ada Lovelace", or "Ada Lovelace <https://orcid.org/...>"
    std::string description;
    std::string date;   ///< of publication, YYYY-MM-DD; empty: the day on which the last run ended
};

/// Called now and then; may throw to stop.
using Pulse = std::function<void()>;

/// What went into a pack.
struct PackCounts {
    std::size_t files = 0, left_out = 0;
    std::uint64_t bytes = 0;   ///< of the files, before they are packed
};

/// Makes a campaign's directory a research object by RO-Crate 1.2 and Process Run Crate 0.5 (docs/manual/formats.md,
/// "Packed campaigns"), and writes it as one archive: `out` ends with .tar.zst, .tar.gz or .zip.
///
/// The archive holds every file of the directory but locks and temporary files, the campaign's file with what it names
/// (inputs/), ro-crate-metadata.json, and SHA256SUMS. The same files and options give the same bytes from one build.
/// All or nothing, and an existing file is never replaced. Throws UsageError: `out` exists or has another ending, a
/// mistake in the options, no run; Error: a step is at work, a link or a special file in the directory, a file that
/// changes meanwhile, a full disk.
PackCounts pack_campaign(
    CampaignPlan const&, CampaignDirectory const&, PackOptions const&, std::string const& out, Pulse const& = [] {});

/// The same metadata in the directory itself, which is then the research object: ro-crate-metadata.json, SHA256SUMS and
/// inputs/, those of before replaced.
PackCounts describe_campaign(
    CampaignPlan const&, CampaignDirectory const&, PackOptions const&, Pulse const& = [] {});

}   // namespace lore
