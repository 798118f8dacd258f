#pragma once

#include "byte_stream.h"

#include <cstdint>
#include <vector>

namespace lore {

// Descriptors::channel_bits in a message. Most steps show the bits of the one before, so only words that differ from
// those of the step before are sent, and maps of where they are:
//
//     words a step (1 byte), words in all (varint)
//     of each 4096 words 8 bytes: a bit for each block of 64, whether a word in it differs
//     of each such block 8 bytes: a bit for each word, whether it differs
//     the words that differ
//
// Before the first step all are 0. Bits count from the lowest.

/// `words_a_step`: Descriptors::words(); 0 where there are no channels, and no words either.
void put_channel_words(ByteWriter&, std::vector<std::uint16_t> const& words, int words_a_step);
/// Into the memory that `words` has. Throws Error on what put_channel_words does not write.
void get_channel_words(ByteReader&, std::vector<std::uint16_t>& words);

}   // namespace lore
