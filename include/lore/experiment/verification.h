#pragma once

#include <string>

namespace lore {

/// Checks one file that Lore wrote, whole: containers by header, lengths, checksum and content, config.toml and .npy by
/// their content, manifest.json by its content and by the checksums of the outputs that it lists; a directory by
/// everything in it that Lore knows. Returns what it is, in one line ("knowledge base of 23734 features").
/// Throws Error: what is wrong with it, or that it is no file of Lore.
std::string verify(std::string const& path);

} // namespace lore
