#pragma once

#include <lore/archive/container.h>
#include <lore/core/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

/// Each target defines it: reads what libFuzzer made up. A reader may give a value or throw lore::Error; anything else,
/// every other exception included, is a defect.
void read_input(std::span<std::byte const> input);

namespace lore::fuzz {

inline std::string_view as_text(std::span<std::byte const> bytes) {
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

/// The payload of a container: the first byte of the input says of which format version.
inline Payload as_payload(std::span<std::byte const> input) {
    if (input.empty()) return {};
    return {Bytes(input.begin() + 1, input.end()), 1 + std::to_integer<std::uint32_t>(input[0]) % container_version};
}

/// A file in memory, for readers that want a path.
class MemoryFile {
public:
    explicit MemoryFile(std::span<std::byte const> content) : descriptor_(::memfd_create("fuzz", 0)) {
        if (descriptor_ < 0 ||
            ::write(descriptor_, content.data(), content.size()) != static_cast<ssize_t>(content.size()))
            std::abort();
    }
    MemoryFile(MemoryFile const&) = delete;
    MemoryFile& operator=(MemoryFile const&) = delete;
    ~MemoryFile() { ::close(descriptor_); }
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

/// Whether `read` gave a value; false if it refused.
template <class Read>
bool accepts(Read const& read) {
    try {
        read();
        return true;
    } catch (Error const&) { return false; }
}

/// A property of what was accepted: its breach is reported as a crash.
inline void demand(bool holds) {
    if (!holds) std::abort();
}

}   // namespace lore::fuzz
