#include "channel_words.h"

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <span>

using namespace lore;

namespace {

using Words = std::vector<std::uint16_t>;

Bytes put(Words const& words, int words_a_step = 1) {
    ByteWriter out;
    put_channel_words(out, words, words_a_step);
    return out.take();
}

Words got(std::span<std::byte const> bytes) {
    Words words{9, 9, 9};   // of the one before
    ByteReader in{bytes, "a test"};
    get_channel_words(in, words);
    in.expect_end();
    return words;
}

Bytes bytes(std::initializer_list<int> numbers) {
    Bytes all;
    for (int const number : numbers) all.push_back(static_cast<std::byte>(number));
    return all;
}

}   // namespace

TEST(ChannelWords, are_sent_where_they_differ_from_the_step_before) {
    Bytes const sent = put({0, 7, 7, 0x102, 0x102});
    EXPECT_EQ(sent, bytes({1,  5,                     // a word a step, five words
                           1,  0, 0, 0, 0, 0, 0, 0,   // in the first block of 64 some differ:
                           10, 0, 0, 0, 0, 0, 0, 0,   // the second and the fourth word
                           7,  0, 2, 1}));
    EXPECT_EQ(got(sent), (Words{0, 7, 7, 0x102, 0x102}));
}

TEST(ChannelWords, of_two_words_a_step_are_compared_with_the_same_word_of_the_step_before) {
    Bytes const sent = put({7, 8, 7, 8, 7, 9}, 2);
    EXPECT_EQ(sent, bytes({2, 6, 1, 0, 0, 0, 0, 0, 0, 0, 0b100011, 0, 0, 0, 0, 0, 0, 0, 7, 0, 8, 0, 9, 0}));
    EXPECT_EQ(got(sent), (Words{7, 8, 7, 8, 7, 9}));
}

TEST(ChannelWords, that_are_all_zero_take_a_bit_a_block) {
    EXPECT_EQ(put(Words(64 * 64)).size(), 3u + 8u);
    EXPECT_EQ(put(Words(64 * 64 + 1)).size(), 3u + 16u);
    EXPECT_EQ(put({}), bytes({1, 0}));
}

TEST(ChannelWords, come_back_whatever_they_are) {
    Stream rng{1, Purpose::test};
    for (int round = 0; round < 400; ++round) {
        int const words_a_step = 1 + static_cast<int>(rng.below(3)), one_in = 1 + static_cast<int>(rng.below(200));
        Words words(words_a_step * rng.below(5000));
        Words step(static_cast<std::size_t>(words_a_step));
        for (std::size_t i = 0; i < words.size(); ++i) {
            std::uint16_t& word = step[i % step.size()];
            if (rng.below(static_cast<std::uint32_t>(one_in)) == 0)   // one bit alone, or any
                word =
                    static_cast<std::uint16_t>(rng.below(2) == 0 ? word ^ (1u << rng.below(16)) : rng.below(1u << 16));
            words[i] = word;
        }
        EXPECT_EQ(got(put(words, words_a_step)), words) << words.size() << " words, " << words_a_step << " a step";
    }
}

TEST(ChannelWords, that_nobody_sends_are_answered_with_an_error) {
    Bytes const sent = put({0, 7, 7, 0x102, 0x102});
    for (std::size_t length = 0; length < sent.size(); ++length)
        EXPECT_THROW(got(std::span{sent}.first(length)), Error) << length;
    auto const with = [&](std::size_t place, int value) {
        Bytes other = sent;
        other[place] = static_cast<std::byte>(value);
        return other;
    };
    EXPECT_THROW(got(with(0, 0)), Error) << "no words a step";
    EXPECT_THROW(got(with(0, 200)), Error) << "more words a step than any world has";
    EXPECT_THROW(got(with(2, 2)), Error) << "a second block of five words";
    EXPECT_THROW(got(with(10, 34)), Error) << "a sixth word of five";
    EXPECT_THROW(got(with(10, 2)), Error) << "fewer words than were sent";
}
