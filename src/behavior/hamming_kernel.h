#pragma once

#include <lore/core/isa.h>

#include <cstdint>

namespace lore {

/// Bits that differ, counted by the widest vectors at hand. Compiled once per instruction set.
struct HammingKernel {
    /// How many bits of `words` 64-bit words differ. Precondition: words is a multiple of hamming_block.
    std::int64_t (*differing)(std::uint64_t const* a, std::uint64_t const* b, int words);
};

/// Words that are counted together: sixteen of the widest vectors.
inline constexpr int hamming_block = 16 * 8;

HammingKernel hamming_kernel(Isa);

} // namespace lore
