#include <lore/core/error.h>

#include <gtest/gtest.h>

using namespace lore;

TEST(Error, is_one_line_that_says_what_is_wrong_why_and_what_to_do) {
    EXPECT_STREQ(Error("cannot read a.toml", "no such file", "Check the path.").what(),
                 "cannot read a.toml (no such file). Check the path.");
    EXPECT_STREQ(Error("nothing is left", "", "").what(), "nothing is left.");
}

TEST(Error, shows_nothing_that_a_terminal_obeys) {
    EXPECT_STREQ(Error("cannot read a\nb", "\x1b[2J\r\x7f", "Caf\u00e9.").what(),
                 "cannot read a b ( [2J  ). Caf\u00e9.");
}
