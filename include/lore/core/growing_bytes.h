#pragma once

#include <lore/core/file.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// Bytes that are only added to: in memory, or, of more than memory should hold, in a file without a name, which goes
/// when its last user does.
class GrowingBytes {
public:
    /// In memory.
    GrowingBytes() = default;
    /// In a file in this folder. Throws Error.
    explicit GrowingBytes(std::string const& folder);

    /// Throws Error: a full disk.
    void add(std::span<std::byte const>);
    /// `size` bytes from `at`: where they lie in memory, of a file mostly a copy in `copy`, which has room for them.
    /// They were added with one call. Threads may read at once while none adds. Throws Error.
    std::byte const* read(std::uint64_t at, std::size_t size, std::byte* copy) const;
    std::uint64_t size() const { return written_ + last_.size(); }

    struct Whole {
        std::span<std::byte const> bytes;
        std::shared_ptr<void const> keep_alive;
    };
    /// All of them, of a file mapped; nothing but destruction may follow. Throws Error.
    Whole release();

private:
    void write_last();
    bool in_memory() const { return file_.get() < 0; }

    std::string path_;              ///< what errors call the file
    FileDescriptor file_;           ///< if not in memory
    std::uint64_t written_ = 0;     ///< to the file
    std::vector<std::byte> last_;   ///< those that were not
};

}   // namespace lore
