#include "exact_tables.h"
#include "exact_hash.h"
#include "exact_keys.h"

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

using namespace lore;

namespace {

/// Whether no number of the key lies outside the range.
bool lies_between(exact::Key const& key, exact::Key const& least, exact::Key const& most) {
    for (int i = 0; i < exact::key_size; ++i)
        if (key.sums[i] < least.sums[i] || key.sums[i] > most.sums[i]) return false;
    return key.ones >= least.ones && key.ones <= most.ones;
}

/// The range that a group of keys is passed over by.
std::pair<exact::Key, exact::Key> range_of(exact::KeyedTable const& table, std::uint32_t group) {
    auto const lane = static_cast<int>(group % exact::key_group);
    return {exact::numbers_at(table.least[group / exact::key_group], lane),
            exact::numbers_at(table.most[group / exact::key_group], lane)};
}

/// That the table has each of the features once, in the bucket of its pattern, with its key and in its group's range.
void expect_all(exact::GrowingTable const& table, exact::Records const& records, std::vector<exact::Key> const& keys) {
    exact::KeyedTable const view = table.view();
    std::vector<int> seen(records.count(), 0);
    std::size_t largest = 0;
    for (std::size_t slot = 0; slot < std::size_t{1} << view.slot_bits; ++slot) {
        exact::Bucket const bucket = view.buckets[slot];
        largest = std::max(largest, std::size_t{bucket.count});
        if (bucket.count > exact::key_group) { ASSERT_EQ(bucket.start % exact::key_group, 0u); }
        for (std::uint32_t place = bucket.start; place < bucket.start + bucket.count; ++place) {
            exact::Key const key = table.keys()[place];
            auto const number = static_cast<std::size_t>(key.feature);
            ASSERT_LT(number, records.count());
            ++seen[number];
            ASSERT_EQ(exact::hash_slot(records[number], view.mask, 1, view.slot_bits), slot);
            ASSERT_TRUE(lies_between(key, keys[number], keys[number]));
            if (bucket.count > exact::key_group) {
                auto const [least, most] = range_of(view, place / exact::key_group);
                ASSERT_TRUE(lies_between(key, least, most));
            }
        }
    }
    ASSERT_EQ(largest, table.largest_bucket());
    ASSERT_EQ(seen, std::vector<int>(records.count(), 1));
}

class GrowingTableOf : public ::testing::TestWithParam<std::uint64_t> {};

}   // namespace

TEST_P(GrowingTableOf, masked_patterns_has_every_feature_once_however_much_it_grows) {
    // Few patterns, some of them often: buckets of one feature and of thousands, which move, are parted and put in
    // order.
    Stream rng{71, Purpose::test};
    exact::GrowingTable table{{GetParam()}};
    exact::Records records{1};
    std::vector<exact::Key> keys;
    for (int i = 0; i < 30'000; ++i) {
        std::uint64_t const rare = rng.below(4) == 0 ? rng.below(5'000) : 0;
        *records.add() = rng.below(3) | rare << 7 | std::uint64_t{rng.below(40)} << 40;
        exact::Key key{{}, static_cast<std::uint8_t>(rng.below(64)), i};
        for (std::uint8_t& sum : key.sums) sum = static_cast<std::uint8_t>(rng.below(256));
        keys.push_back(key);
        table.add(records, key);
        if (i % 4'999 == 0) expect_all(table, records, keys);
    }
    EXPECT_GT(table.largest_bucket(), 150u);
    expect_all(table, records, keys);
}

TEST_P(GrowingTableOf, masked_patterns_that_was_cleared_is_filled_like_a_new_one) {
    Stream rng{74, Purpose::test};
    exact::GrowingTable table{{GetParam()}};
    exact::Records records{1};
    for (int const features : {5'000, 0, 300, 9'000}) {
        table.clear();
        records.clear();
        expect_all(table, records, {});
        std::vector<exact::Key> keys;
        for (int i = 0; i < features; ++i) {
            *records.add() = rng.below(3) | std::uint64_t{rng.below(400)} << 7;
            exact::Key key{{}, static_cast<std::uint8_t>(rng.below(64)), i};
            for (std::uint8_t& sum : key.sums) sum = static_cast<std::uint8_t>(rng.below(256));
            keys.push_back(key);
            table.add(records, key);
        }
        expect_all(table, records, keys);
    }
}
INSTANTIATE_TEST_SUITE_P(Masks, GrowingTableOf,
                         ::testing::Values(0x00000000ffffffffu, 0xffffffff00000000u, ~std::uint64_t{0}));

TEST(GrowingTable, puts_keys_that_are_alike_into_one_group_also_between_two_doublings) {
    // 96 keys of one pattern, of two kinds in turn: in the order of their coming each group would have both.
    exact::GrowingTable table{{~std::uint64_t{0}}};
    exact::Records records{1};
    for (int i = 0; i < 96; ++i) {
        *records.add() = 1;
        table.add(records, {{static_cast<std::uint8_t>(i % 2 == 0 ? 10 : 200)}, 0, i});
    }
    exact::KeyedTable const view = table.view();
    std::uint64_t const pattern = 1;
    std::uint32_t const first = view.buckets[exact::hash_slot(&pattern, view.mask, 1, view.slot_bits)].start / 16;
    for (std::uint32_t group = first; group < first + 6; ++group) {
        auto const [least, most] = range_of(view, group);
        EXPECT_EQ(least.sums[0], most.sums[0]);
    }
}

TEST(GroupedKeys, are_put_into_an_order_in_which_groups_differ_in_the_number_that_varies_most) {
    // 32 keys whose ones fall from 31 to 0, while a sum is 7 or 8: the first group has the smaller half of the ones.
    std::vector<exact::Key> keys;
    for (int i = 0; i < 32; ++i)
        keys.push_back({{static_cast<std::uint8_t>(7 + i % 2)}, static_cast<std::uint8_t>(31 - i), i});
    exact::GroupedKeys::order(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ(keys[i].ones < 16, i < 16) << i;
}

TEST(LanesOf, a_group_are_those_whose_places_are_in_the_bucket) {
    EXPECT_EQ(exact::lanes_of({32, 16}, 2), 0xffffu);
    EXPECT_EQ(exact::lanes_of({32, 40}, 3), 0xffffu);
    EXPECT_EQ(exact::lanes_of({32, 40}, 4), 0x00ffu);   // places 64 to 71
    EXPECT_EQ(exact::lanes_of({36, 4}, 2), 0x00f0u);
    EXPECT_EQ(exact::lanes_of({47, 1}, 2), 0x8000u);
}

TEST(NearKeys, are_those_whose_squares_and_ones_differ_little_enough_from_the_range) {
    Stream rng{72, Purpose::test};
    for (int round = 0; round < 200; ++round) {
        auto const any_key = [&](std::uint64_t limit) {
            exact::Key key{{}, static_cast<std::uint8_t>(rng.below(limit)), -1};
            for (std::uint8_t& sum : key.sums) sum = static_cast<std::uint8_t>(rng.below(limit));
            return key;
        };
        exact::NearKeys const near{any_key(256), static_cast<int>(rng.below(300)),
                                   static_cast<std::int32_t>(rng.below(300'000))};
        auto const lanes = static_cast<exact::LaneMask>(rng.below(0x10000));
        exact::KeyNumbers least{}, most{};
        std::vector<std::int32_t> names(exact::key_group), wanted, wanted_apart;
        for (int lane = 0; lane < exact::key_group; ++lane) {
            exact::Key const from = any_key(256), width = any_key(round % 2 == 0 ? 1 : 64);
            exact::Key to = from;
            std::int32_t apart = 0;
            for (int i = 0; i < exact::key_size; ++i) {
                to.sums[i] = static_cast<std::uint8_t>(std::min(255, from.sums[i] + width.sums[i]));
                int const away = exact::outside(near.key.sums[i], from.sums[i], to.sums[i]);
                apart += away * away;
            }
            to.ones = static_cast<std::uint8_t>(std::min(255, from.ones + width.ones));
            exact::put_numbers(least, lane, from);
            exact::put_numbers(most, lane, to);
            names[static_cast<std::size_t>(lane)] = 1000 + lane;
            if ((lanes >> lane & 1) == 0 || apart > near.largest ||
                exact::outside(near.key.ones, from.ones, to.ones) > near.most_differing)
                continue;
            wanted.push_back(1000 + lane);
            wanted_apart.push_back(apart);
        }
        std::vector<std::int32_t> found(2 * exact::key_group), found_apart(2 * exact::key_group);
        auto const take = [&](std::int32_t const* named, std::uint32_t first) {
            int const count =
                exact::near_keys(least, most, lanes, named, first, near, {found.data(), found_apart.data()});
            ASSERT_EQ(count, static_cast<int>(wanted.size()));
            EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), found.begin()));
            EXPECT_TRUE(std::equal(wanted_apart.begin(), wanted_apart.end(), found_apart.begin()));
        };
        take(names.data(), 0);
        take(nullptr, 1000);
    }
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
