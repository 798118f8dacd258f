#pragma once

#include <lore/archive/container.h>

#include <cstring>

namespace lore {

/// A zstd frame of 17 bytes whose header claims `length` bytes: its one block holds 128 KiB of zeros (RFC 8878, 3.1.1).
inline Bytes zstd_claiming(std::uint64_t length) {
    unsigned char const head[]{0x28, 0xb5, 0x2f, 0xfd, 0xe0};   // magic; 8 bytes of length, a single segment
    unsigned char const block[]{0x03, 0x00, 0x10, 0x00};        // the last, repeating one byte 2^17 times
    Bytes frame(sizeof head + sizeof length + sizeof block);
    std::memcpy(frame.data(), head, sizeof head);
    std::memcpy(frame.data() + sizeof head, &length, sizeof length);
    std::memcpy(frame.data() + sizeof head + sizeof length, block, sizeof block);
    return frame;
}

}   // namespace lore
