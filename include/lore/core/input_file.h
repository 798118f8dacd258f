#pragma once

#include <lore/core/file.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lore {

/// The most that is read of a file of one kind [bytes]; a longer one is another file, or has no end.
inline constexpr std::uint64_t most_text = std::uint64_t{16} << 20;   ///< configuration, arena, campaign, numbers
inline constexpr std::uint64_t most_data = std::uint64_t{16} << 30;   ///< tables, arrays, Lore's own files
/// The most that is read of a stream, whatever its kind: a stream does not say its length, and is kept in memory.
inline constexpr std::uint64_t most_of_stream = std::uint64_t{256} << 20;

/// A file that the user has named, open for reading: a regular one, or a stream (a pipe, a terminal, a device), which
/// can be read once and does not know its size.
struct InputFile {
    std::string path;   ///< as errors call it
    FileDescriptor descriptor;
    bool regular = true;
    std::uint64_t size = 0;   ///< of a regular one [bytes]
};

/// Throws a UsageError where the name is wrong (missing, a directory, not readable), an Error where the system fails.
/// Never waits for the writer of a pipe; reading does.
InputFile open_input(std::string const& path);
/// Likewise, and refuses streams: for what is mapped, or read more than once.
InputFile open_regular(std::string const& path);

/// The whole file, from its present position. A pipe that no process opens for writing within 5 s, or whose writer is
/// silent for 60 s, is a UsageError, and so is a file of more than `limit` bytes.
std::vector<std::byte> read_bytes(InputFile const&, std::uint64_t limit = most_data);
std::vector<std::byte> read_bytes(std::string const& path, std::uint64_t limit = most_data);
std::string read_text(std::string const& path, std::uint64_t limit = most_text);

/// The first or the last `bytes` of a regular file, all of it if it has no more. Throws Error where the system fails.
std::string first_bytes(InputFile const&, std::uint64_t bytes);
std::string last_bytes(InputFile const&, std::uint64_t bytes);

}   // namespace lore
