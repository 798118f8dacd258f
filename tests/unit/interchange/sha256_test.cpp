#include <interchange/sha256.h>

#include "support/scratch.h"

#include <fstream>

using namespace lore;

TEST(Sha256, is_that_of_the_standard) {
    // FIPS 180-2, appendix B, and the empty text.
    EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sha256, of_a_file_is_that_of_its_pieces_one_after_the_other) {
    Scratch const scratch;
    std::string const text(3'000'000, 'a');   // three pieces
    std::ofstream{scratch.file("f")} << text;
    std::string pieces;
    int pauses = 0;
    FileSum const sum = read_in_pieces(
        scratch.file("f"), [&] { ++pauses; },
        [&](std::span<std::byte const> piece) {
            pieces.append(reinterpret_cast<char const*>(piece.data()), piece.size());
        });
    EXPECT_EQ(sum.bytes, text.size());
    EXPECT_EQ(sum.sha256, sha256_of(text));
    EXPECT_TRUE(pieces == text);
    EXPECT_GE(pauses, 3);
}
