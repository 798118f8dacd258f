#include <lore/core/utf8.h>

#include <gtest/gtest.h>

using namespace lore;

TEST(Utf8, characters_have_one_to_four_bytes) {
    EXPECT_EQ(printable_bytes("ab"), 1u);
    EXPECT_EQ(printable_bytes("\xc3\xa4 "), 2u) << "U+00E4";
    EXPECT_EQ(printable_bytes("\xc2\xa0"), 2u) << "U+00A0";
    EXPECT_EQ(printable_bytes("\xe0\xa0\x80"), 3u) << "U+0800";
    EXPECT_EQ(printable_bytes("\xed\x9f\xbf"), 3u) << "U+D7FF";
    EXPECT_EQ(printable_bytes("\xee\x80\x80"), 3u) << "U+E000";
    EXPECT_EQ(printable_bytes("\xf0\x90\x80\x80"), 4u) << "U+10000";
    EXPECT_EQ(printable_bytes("\xf4\x8f\xbf\xbf"), 4u) << "U+10FFFF";
}

TEST(Utf8, is_not_what_is_cut_too_long_a_surrogate_or_beyond_the_last_character) {
    for (char const* text : {"", "\x80", "\xc3", "\xc3z", "\xe2\x82", "\xe2\x82z", "\xf0\x90\x80", "\xc0\x80",
                             "\xc1\xbf", "\xe0\x80\x80", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xed\xa0\x80",
                             "\xed\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff"})
        EXPECT_EQ(printable_bytes(text), 0u) << text;
}

TEST(Utf8, has_control_characters_which_nobody_can_see) {
    for (char const* text : {"\x01", "\n", "\x1b[", "\x7f", "\xc2\x80", "\xc2\x9b", "\xc2\x9f"})
        EXPECT_EQ(printable_bytes(text), 0u) << text;
}

TEST(Utf8, is_printable_where_every_character_is) {
    EXPECT_TRUE(is_printable("m\xc2\xb2 gained"));
    EXPECT_TRUE(is_printable(""));
    for (char const* text : {"m\xb2", "a\tb", "a\x7f"}) EXPECT_FALSE(is_printable(text)) << text;
}

TEST(Harmless, text_has_no_character_that_steers_a_terminal) {
    EXPECT_EQ(harmless("plain, gr\xc3\xb6\xc3\x9f"
                       "er \xf0\x9f\xa4\x96"),
              "plain, gr\xc3\xb6\xc3\x9f"
              "er \xf0\x9f\xa4\x96");
    EXPECT_EQ(harmless("\033[31m\n\t\r\x7f"), "?[31m????");
    EXPECT_EQ(harmless("\xc2\x9b"
                       "31m"),
              "??31m")
        << "CSI as one character of C1";
    EXPECT_EQ(harmless("\x9b"
                       "31m \xff \xc3"),
              "?31m ? ?")
        << "no UTF-8";
    EXPECT_EQ(harmless(""), "");
}
