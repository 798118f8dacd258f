#include <lore/core/terminal.h>

#include <gtest/gtest.h>

using namespace lore;

TEST(CutToColumns, leaves_the_last_column_free_and_cuts_no_character) {
    EXPECT_EQ(cut_to_columns("abc", 4), "abc");
    EXPECT_EQ(cut_to_columns("abcd", 4), "abc");
    EXPECT_EQ(cut_to_columns("xÜber", 3), "xÜ");
    EXPECT_EQ(cut_to_columns("xÜber", 1), "");
    EXPECT_EQ(cut_to_columns("", 80), "");
}
