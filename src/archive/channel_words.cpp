#include "channel_words.h"

#include "field_limits.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>

namespace lore {

namespace {

using Words = std::vector<std::uint16_t>;
using Maps = std::vector<std::uint64_t>;

constexpr std::size_t block_words = 64;                ///< that one map has a bit for each of
constexpr std::size_t longest_evaluation = 1u << 24;   ///< words
constexpr std::size_t most_words_a_step = (most_channels + 15) / 16;

std::size_t blocks_in(std::size_t things) { return (things + block_words - 1) / block_words; }

/// The word of the step before; 0 before the first step.
std::uint16_t word_before(Words const& words, std::size_t place, std::size_t in_a_step) {
    return place < in_a_step ? std::uint16_t{0} : words[place - in_a_step];
}

/// Of a whole block, four words at a time and without a jump: which words differ is hard to guess.
std::uint64_t differing(std::uint16_t const* words, std::uint16_t const* before) {
    static_assert(std::endian::native == std::endian::little, "the first of four words is the lowest part of a number");
    constexpr std::uint64_t all_but_high = 0x7fff'7fff'7fff'7fff;
    std::uint64_t which = 0;
    for (std::size_t i = 0; i < block_words; i += 4) {
        std::uint64_t four, four_before;
        std::memcpy(&four, words + i, sizeof four);
        std::memcpy(&four_before, before + i, sizeof four_before);
        std::uint64_t const difference = four ^ four_before;
        std::uint64_t const high = (((difference & all_but_high) + all_but_high) | difference) & ~all_but_high;
        which |= ((high >> 15) * 0x0001'0002'0004'0008 >> 48 & 0xf) << i;   // brings bits 16 apart side by side
    }
    return which;
}

std::uint64_t differing_in(Words const& words, std::size_t first, std::size_t in_a_step) {
    std::size_t const end = std::min(first + block_words, words.size());
    if (first >= in_a_step && end - first == block_words) return differing(&words[first], &words[first - in_a_step]);
    std::uint64_t which = 0;
    for (std::size_t i = first; i < end; ++i)
        which |= std::uint64_t{words[i] != word_before(words, i, in_a_step)} << (i - first);
    return which;
}

}   // namespace

void put_channel_words(ByteWriter& out, Words const& words, int words_a_step) {
    std::size_t const in_a_step = static_cast<std::size_t>(std::max(1, words_a_step));
    Maps blocks(blocks_in(blocks_in(words.size()))), maps;
    Words sent(words.size());
    std::size_t count = 0;
    for (std::size_t first = 0; first < words.size(); first += block_words) {
        std::uint64_t const which = differing_in(words, first, in_a_step);
        if (which == 0) continue;
        std::size_t const block = first / block_words;
        blocks[block / block_words] |= std::uint64_t{1} << block % block_words;
        maps.push_back(which);
        for (std::uint64_t rest = which; rest != 0; rest &= rest - 1)
            sent[count++] = words[first + static_cast<std::size_t>(std::countr_zero(rest))];
    }
    out.put(static_cast<std::uint8_t>(in_a_step));
    out.put_varint(words.size());
    out.put_all(std::span<std::uint64_t const>{blocks});
    out.put_all(std::span<std::uint64_t const>{maps});
    out.put_all(std::span<std::uint16_t const>{sent}.first(count));
}

namespace {

std::size_t bits_in(Maps const& maps) {
    return std::transform_reduce(maps.begin(), maps.end(), std::size_t{0}, std::plus<>{},
                                 [](std::uint64_t map) { return static_cast<std::size_t>(std::popcount(map)); });
}

/// Whether maps of `things` leave the bits of all others 0.
bool fits(std::uint64_t last_map, std::size_t things) {
    std::size_t const in_last = things % block_words;
    return in_last == 0 || last_map >> in_last == 0;
}

/// The words that were sent, one after the other.
class Sent {
public:
    Sent(ByteReader& in, std::size_t count) : words_(1 + count) { in.get_into(std::span{words_}.subspan(1)); }

    /// The next if the map's lowest bit says so, or else the last once more; before the first 0.
    std::uint16_t next_if(std::uint64_t map) { return *(at_ += map & 1); }
    std::uint16_t last() const { return *at_; }

private:
    Words words_;
    std::uint16_t const* at_ = words_.data();
};

}   // namespace

void get_channel_words(ByteReader& in, Words& words) {
    std::size_t const in_a_step = in.get<std::uint8_t>();
    if (in_a_step == 0 || in_a_step > most_words_a_step) in.fail("steps of no world");
    words.resize(in.get_count(std::min(longest_evaluation, block_words * block_words * in.left())));
    std::size_t const block_count = blocks_in(words.size());
    Maps const blocks = in.get_all<std::uint64_t>(blocks_in(block_count));
    if (!blocks.empty() && !fits(blocks.back(), block_count)) in.fail("a block after the last one");
    Maps const maps = in.get_all<std::uint64_t>(bits_in(blocks));
    Sent sent{in, bits_in(maps)};
    auto map = maps.begin();
    for (std::size_t block = 0; block < block_count; ++block) {
        std::size_t const first = block * block_words, end = std::min(first + block_words, words.size());
        bool const any = (blocks[block / block_words] >> block % block_words & 1) != 0;
        std::uint64_t which = any ? *map++ : 0;
        if (end - first < block_words && !fits(which, words.size())) in.fail("a word after the last one");
        if (in_a_step > 1) {
            for (std::size_t i = first; i < end; ++i, which >>= 1) {
                std::uint16_t const word = sent.next_if(which);
                words[i] = (which & 1) != 0 ? word : word_before(words, i, in_a_step);
            }
        } else if (which == 0) {
            std::fill(words.data() + first, words.data() + end, sent.last());
        } else {   // the word of the step before is the last that was sent
            for (std::size_t i = first; i < end; ++i, which >>= 1) words[i] = sent.next_if(which);
        }
    }
}

}   // namespace lore
