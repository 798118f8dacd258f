#include "exact_tables.h"
#include "exact_hash.h"

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <map>
#include <vector>

using namespace lore;

namespace {

/// Whether no number of the key lies outside the range.
bool lies_between(exact::Key const& key, exact::Key const& least, exact::Key const& most) {
    for (int i = 0; i < exact::key_size; ++i)
        if (key.sums[i] < least.sums[i] || key.sums[i] > most.sums[i]) return false;
    return key.ones >= least.ones && key.ones <= most.ones;
}

/// That each table has each of the features once, in the bucket of its pattern, with its key and in its group's range.
void expect_all(exact::GrowingTables const& tables, int count, exact::Records const& records,
                std::vector<exact::Key> const& keys) {
    exact::Tables const view = tables.view();
    std::size_t const slots = std::size_t{1} << view.slot_bits;
    for (int table = 0; table < count; ++table) {
        std::vector<int> seen(records.count(), 0);
        std::size_t largest = 0;
        for (std::size_t slot = 0; slot < slots; ++slot) {
            exact::Bucket const bucket = view.buckets[static_cast<std::size_t>(table) * slots + slot];
            largest = std::max(largest, std::size_t{bucket.count});
            if (bucket.count > exact::key_group) { ASSERT_EQ(bucket.start % exact::key_group, 0u); }
            for (std::uint32_t place = bucket.start; place < bucket.start + bucket.count; ++place) {
                exact::Key const& key = tables.keys().keys()[place];
                auto const number = static_cast<std::size_t>(key.feature);
                ASSERT_LT(number, records.count());
                ++seen[number];
                ASSERT_EQ(exact::hash_slot(records[number], view.masks + table, 1, view.slot_bits), slot);
                ASSERT_TRUE(lies_between(key, keys[number], keys[number]));
                if (bucket.count > exact::key_group) {
                    std::uint32_t const group = place / exact::key_group;
                    ASSERT_EQ(tables.keys().least()[group].feature, static_cast<std::int32_t>(group));
                    ASSERT_TRUE(lies_between(key, tables.keys().least()[group], tables.keys().most()[group]));
                }
            }
        }
        ASSERT_LE(largest, tables.largest_bucket());
        ASSERT_EQ(seen, std::vector<int>(records.count(), 1));
    }
}

}   // namespace

TEST(GrowingTables, have_every_feature_once_in_each_table_however_much_they_grow) {
    // Few patterns, some of them often: buckets of one feature and of thousands, which move, are parted and put in
    // order.
    std::vector<std::uint64_t> const masks{0x00000000ffffffffu, 0xffffffff00000000u, ~std::uint64_t{0}};
    Stream rng{71, Purpose::test};
    exact::GrowingTables tables{3, masks};
    exact::Records records{1};
    std::vector<exact::Key> keys;
    for (int i = 0; i < 30'000; ++i) {
        std::uint64_t const rare = rng.below(4) == 0 ? rng.below(5'000) : 0;
        *records.add() = rng.below(3) | rare << 7 | std::uint64_t{rng.below(40)} << 40;
        exact::Key key{};
        for (std::uint8_t& sum : key.sums) sum = static_cast<std::uint8_t>(rng.below(256));
        key.ones = static_cast<std::uint8_t>(rng.below(64));
        keys.push_back(key);
        tables.add(records, key);
        if (i % 4'999 == 0) expect_all(tables, 3, records, keys);
    }
    EXPECT_GT(tables.largest_bucket(), 5'000u);
    expect_all(tables, 3, records, keys);
}

TEST(GrowingTables, put_keys_that_are_alike_into_one_group_where_a_bucket_doubles) {
    // 64 keys of one pattern, of two kinds in turn: in the order of their coming each group has both.
    exact::GrowingTables tables{1, {~std::uint64_t{0}}};
    exact::Records records{1};
    for (int i = 0; i < 65; ++i) {   // the last one makes the bucket double
        *records.add() = 1;
        tables.add(records, {{static_cast<std::uint8_t>(i % 2 == 0 ? 10 : 200)}, 0, -1});
    }
    exact::Tables const view = tables.view();
    std::uint64_t const pattern = 1;
    std::uint32_t const first = view.buckets[exact::hash_slot(&pattern, view.masks, 1, view.slot_bits)].start / 16;
    for (std::uint32_t group = first; group < first + 4; ++group)
        EXPECT_EQ(tables.keys().least()[group].sums[0], tables.keys().most()[group].sums[0]);
}

TEST(FixedTables, know_how_many_records_the_buckets_of_a_pattern_hold_at_most) {
    // Two tables, of the lower and of the upper half of a word. Four patterns agree in the lower half, two of them and
    // another in the upper: buckets of 4 and 1, and of 3, 1 and 1.
    std::vector<std::uint64_t> const masks{0x00000000ffffffffu, 0xffffffff00000000u};
    exact::Records records{exact::record_size(1)};
    for (std::uint64_t const pattern :
         {0x0000000100000007u, 0x0000000100000007u, 0x0000000200000007u, 0x0000000300000007u, 0x0000000100000008u})
        *records.add() = pattern;
    EXPECT_EQ(exact::FixedTables(2, masks, records).most_visits(), 4u + 3u);
}

TEST(FixedTables, of_no_records_have_none) {
    std::vector<std::uint64_t> const masks{~std::uint64_t{0}};
    exact::Records const records{exact::record_size(1)};
    EXPECT_EQ(exact::FixedTables(1, masks, records).most_visits(), 0u);
}
