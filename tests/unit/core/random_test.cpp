#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <set>

using namespace lore;

TEST(Stream, gives_the_known_answer_of_philox_4x32_10_for_a_zero_key_and_counter) {
    // Known-answer vector of Random123 (kat_vectors, philox4x32 10 rounds, all zero).
    Stream stream{0, static_cast<Purpose>(0)};
    EXPECT_EQ(stream.bits(), 0x6627e8d5u);
    EXPECT_EQ(stream.bits(), 0xe169c58du);
    EXPECT_EQ(stream.bits(), 0xbc57ac4cu);
    EXPECT_EQ(stream.bits(), 0x9b00dbd8u);
}

TEST(Stream, is_a_function_of_who_asks) {
    Stream a{7, Purpose::mutation, 3, 9}, b{7, Purpose::mutation, 3, 9}, c{7, Purpose::mutation, 3, 10};
    std::uint64_t const first = a.bits64();
    EXPECT_EQ(first, b.bits64());
    EXPECT_NE(first, c.bits64());
}

TEST(Stream, draws_below_a_count_evenly) {
    Stream rng{1, Purpose::test};
    std::array<int, 7> seen{};
    for (int i = 0; i < 70000; ++i) ++seen[rng.below(7)];
    for (int count : seen) EXPECT_NEAR(count, 10000, 500);   // five standard deviations
}
