#include <lore/core/paged_array.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <utility>

using lore::PagedArray;

TEST(PagedArray, keeps_its_items_while_it_grows_over_many_pages) {
    PagedArray<std::uint64_t> array;
    EXPECT_EQ(array.size(), 0u);
    constexpr std::uint64_t count = 100'000;
    for (std::uint64_t i = 0; i < count; ++i) array.push_back(i * i);
    ASSERT_EQ(array.size(), count);
    for (std::uint64_t i = 0; i < count; ++i) ASSERT_EQ(array[i], i * i);
}

TEST(PagedArray, has_zeros_where_nothing_was_written) {
    PagedArray<std::uint16_t> array{3};
    array[1] = 7;
    array.resize(1'000'000);
    EXPECT_EQ(array[1], 7);
    EXPECT_EQ(std::accumulate(array.data(), array.data() + array.size(), std::uint64_t{0}), 7u);
}

TEST(PagedArray, begins_at_a_page) {
    PagedArray<std::uint8_t> array{1};
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 4096, 0u);
}

TEST(PagedArray, goes_to_another_owner) {
    PagedArray<int> first{2};
    first[0] = 5;
    PagedArray<int> second{std::move(first)}, third{9};
    third = std::move(second);
    ASSERT_EQ(third.size(), 2u);
    EXPECT_EQ(third[0], 5);
}

TEST(PagedArray, says_so_where_there_is_no_memory) {
    PagedArray<std::uint64_t> array;
    EXPECT_THROW(array.resize(std::size_t{1} << 58), std::bad_alloc);
    EXPECT_EQ(array.size(), 0u);
}
