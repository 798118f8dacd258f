#pragma once

#include <functional>
#include <string>

namespace lore {

/// Checks one file that Lore wrote, whole: containers by header, lengths, checksum and content; config.toml,
/// arena.toml, progress.csv and .npy by their content; manifest.json by its content and by the checksums of the outputs
/// that it lists; other CSV and JSON files by their form alone; a directory by everything in it that Lore knows, and by
/// what every run has. Returns what it is, in one line ("knowledge base of 23734 features"). Throws Error: what is
/// wrong with it, or that it is no file of Lore.
std::string verify(std::string const& path);

/// Likewise, for a copy that is known to lack files: an output that a manifest lists is not missed if `lacks` says so
/// of its path.
std::string verify(std::string const& path, std::function<bool(std::string const& path)> const& lacks);

}   // namespace lore
