#include "zstd_frame.h"

#include <zstd.h>

namespace lore {

namespace {

constexpr std::uint64_t most_expansion = 32768;   ///< 128 KiB (ZSTD_BLOCKSIZE_MAX) of a block of 4 bytes

}   // namespace

bool may_unpack_to(std::span<std::byte const> packed, std::uint64_t raw_length) {
    return raw_length / most_expansion <= packed.size() &&
           ZSTD_getFrameContentSize(packed.data(), packed.size()) == raw_length;
}

std::optional<Bytes> unpack_frame(std::span<std::byte const> packed, std::uint64_t raw_length) {
    if (!may_unpack_to(packed, raw_length)) return std::nullopt;
    Bytes raw(raw_length);
    std::size_t const got = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) || got != raw.size()) return std::nullopt;
    return raw;
}

}   // namespace lore
