#pragma once

#include <lore/core/lanes.h>

#include <cstdint>

namespace lore::exact {

/// The slot, of 2^bits, of those bits of a pattern that a mask selects; no mask selects all.
LORE_INLINE std::uint64_t hash_slot(std::uint64_t const* words, std::uint64_t const* mask, int count, int bits) {
    std::uint64_t hash = 0;
    for (int word = 0; word < count; ++word) {
        hash = (hash ^ (mask == nullptr ? words[word] : words[word] & mask[word])) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return (hash * 0x9e3779b97f4a7c15u) >> (64 - bits);
}

}   // namespace lore::exact
