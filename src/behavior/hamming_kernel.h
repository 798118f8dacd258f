#pragma once

#include <lore/core/isa.h>

#include <cstddef>
#include <cstdint>

namespace lore {

/// One channel over so many steps is a plane: sixteen words of bits, in an order of steps that is the same for all
/// planes made by the same instruction set.
inline constexpr int steps_per_plane = 1024;
inline constexpr int words_per_plane = steps_per_plane / 64;
inline constexpr int channels_of_word = 16;   ///< a bit each

/// What the Hamming distance needs of an instruction set.
struct HammingKernel {
    int lanes;   ///< planes in a group: 64-bit words in a native vector
    /// Turns steps_per_plane words into a plane for each of their lowest `channels` bits, 1 to channels_of_word; the
    /// planes lie `stride` 64-bit words apart.
    void (*split)(std::uint16_t const* bits, std::uint64_t* planes, std::ptrdiff_t stride, int channels);
    /// Differing bits between a plane and each of `groups` * lanes others, which lie [group][word][lane].
    void (*differing)(std::uint64_t const* plane, std::uint64_t const* others, int groups, std::uint32_t* counts);
    /// terms[j] = counts[class_of[j]]. In 16 bits, of which sums of a stretch need no more: half of the memory.
    void (*spread)(std::uint32_t const* counts, std::int32_t const* class_of, int size, std::uint16_t* terms);
    /// sums[j] += terms[j]
    void (*add)(std::uint16_t const* terms, int size, std::uint16_t* sums);
};

/// `by_instruction`: counts with AVX-512's instruction for it, where the processor has it.
LORE_KERNEL(HammingKernel hamming(bool by_instruction))

}   // namespace lore
