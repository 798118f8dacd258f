#include <lore/core/lanes.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace lore;

template <class V>
class LanesTest : public testing::Test {};
using Widths = testing::Types<Lanes<float, 4>, Lanes<float, 8>, Lanes<float, 16>>;
TYPED_TEST_SUITE(LanesTest, Widths);

TYPED_TEST(LanesTest, computes_each_lane_as_the_scalar_would) {
    using V = TypeParam;
    constexpr int width = LaneTraits<V>::width;
    V a{}, b{};
    for (int i = 0; i < width; ++i) {
        a[i] = static_cast<float>(i) * 1.37f - 3.0f;
        b[i] = static_cast<float>(i % 3) - 0.5f;
    }
    V const least = lanes::min(a, b), most = lanes::max(a, b), chosen = lanes::select(a < b, a, b),
            magnitude = lanes::abs(a);
    V const root = lanes::sqrt(magnitude);
    auto const cut = lanes::truncate(a);
    auto const near = lanes::round<V>(a);
    for (int i = 0; i < width; ++i) {
        EXPECT_EQ(least[i], std::min(a[i], b[i]));
        EXPECT_EQ(most[i], std::max(a[i], b[i]));
        EXPECT_EQ(chosen[i], a[i] < b[i] ? a[i] : b[i]);
        EXPECT_EQ(magnitude[i], std::fabs(a[i]));
        EXPECT_EQ(root[i], std::sqrt(magnitude[i]));
        EXPECT_EQ(cut[i], static_cast<int>(a[i]));
        EXPECT_EQ(near.value[i], std::nearbyint(a[i]));
        EXPECT_EQ(near.integer[i], static_cast<int>(std::nearbyint(a[i])));
    }
}

TYPED_TEST(LanesTest, knows_which_lanes_a_mask_holds) {
    using V = TypeParam;
    constexpr int width = LaneTraits<V>::width;
    V a{};
    for (int i = 0; i < width; ++i) a[i] = static_cast<float>(i);
    EXPECT_EQ(lanes::mask_bits(a < 2.0f), 3u);
    EXPECT_TRUE(lanes::any(a == 3.0f));
    EXPECT_FALSE(lanes::any(a < 0.0f));
    EXPECT_TRUE(lanes::all(a >= 0.0f));
    EXPECT_FALSE(lanes::all(a > 0.0f));
}

TYPED_TEST(LanesTest, ors_its_integers_together) {
    using V = TypeParam;
    constexpr int width = LaneTraits<V>::width;
    IntOf<V> bits{};
    EXPECT_EQ(lanes::reduce_or(bits), 0u);
    for (int i = 0; i < width; ++i) bits[i] = 1 << (2 * i % 31);
    std::uint32_t expected = 0;
    for (int i = 0; i < width; ++i) expected |= 1u << (2 * i % 31);
    EXPECT_EQ(lanes::reduce_or(bits), expected);
}

TYPED_TEST(LanesTest, selects_by_the_sign_bit) {
    using V = TypeParam;
    constexpr int width = LaneTraits<V>::width;
    IntOf<V> sign{};
    V a{}, b{};
    for (int i = 0; i < width; ++i) {
        sign[i] = i % 3 == 0 ? -1 - i : i % 3 == 1 ? 0 : 0x7fffffff;
        a[i] = 1.0f + static_cast<float>(i);
        b[i] = -0.5f;
    }
    V const chosen = lanes::select_negative(sign, a, b);
    for (int i = 0; i < width; ++i) EXPECT_EQ(chosen[i], i % 3 == 0 ? 1.0f + static_cast<float>(i) : -0.5f);
}

TYPED_TEST(LanesTest, joins_bits_that_are_in_the_first_and_in_either_other) {
    using V = TypeParam;
    auto const all = [](std::int32_t bits) { return lanes::all_of<IntOf<V>>(bits); };
    IntOf<V> const joined = lanes::and_either(all(0b11110000), all(0b11001100), all(0b10101010));
    for (int i = 0; i < LaneTraits<V>::width; ++i) EXPECT_EQ(joined[i], 0b11100000);
}

TYPED_TEST(LanesTest, gathers_from_a_table) {
    using V = TypeParam;
    constexpr int width = LaneTraits<V>::width;
    float table[64];
    std::int32_t numbers[64];
    for (int i = 0; i < 64; ++i) {
        table[i] = 0.5f * static_cast<float>(i);
        numbers[i] = 7 * i;
    }
    IntOf<V> index{};
    for (int i = 0; i < width; ++i) index[i] = (i * 11) % 64;
    auto const values = lanes::gather(table, index);
    auto const integers = lanes::gather(numbers, index);
    for (int i = 0; i < width; ++i) {
        EXPECT_EQ(values[i], table[(i * 11) % 64]);
        EXPECT_EQ(integers[i], 7 * ((i * 11) % 64));
    }
    auto const pairs = lanes::gather_pairs(numbers, IntOf<V>(index / 2));
    for (int i = 0; i < width; ++i) {
        EXPECT_EQ(pairs.low[i], 14 * ((i * 11) % 64 / 2));
        EXPECT_EQ(pairs.high[i], 14 * ((i * 11) % 64 / 2) + 7);
    }
}
