#include "exact_tables.h"

#include <gtest/gtest.h>

#include <vector>

using namespace lore;

TEST(FixedTables, know_how_many_records_the_buckets_of_a_pattern_hold_at_most) {
    // Two tables, of the lower and of the upper half of a word. Four patterns agree in the lower half, two of them and
    // another in the upper: buckets of 4 and 1, and of 3, 1 and 1.
    std::vector<std::uint64_t> const masks{0x00000000ffffffffu, 0xffffffff00000000u};
    exact::Records records{1};
    for (std::uint64_t const pattern :
         {0x0000000100000007u, 0x0000000100000007u, 0x0000000200000007u, 0x0000000300000007u, 0x0000000100000008u})
        *records.add() = pattern;
    EXPECT_EQ(exact::FixedTables(2, masks, records).most_visits(), 4u + 3u);
}

TEST(FixedTables, of_no_records_have_none) {
    std::vector<std::uint64_t> const masks{~std::uint64_t{0}};
    exact::Records const records{1};
    EXPECT_EQ(exact::FixedTables(1, masks, records).most_visits(), 0u);
}
