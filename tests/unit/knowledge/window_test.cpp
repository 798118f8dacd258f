#include "knowledge/traces.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

using namespace lore;
using lore::test::trace_of;

TEST(WindowsOf, cuts_a_trace_without_overlap_and_leaves_out_an_unfilled_end) {
    Trace const trace = trace_of({{1, 0.1f}, {2, 0.2f}, {3, 0.3f}, {4, 0.4f}, {5, 0.5f}});
    std::vector<Window> const windows = windows_of(trace, 2);
    ASSERT_EQ(windows.size(), 2u);
    EXPECT_EQ(windows[0].bits.data(), trace.channel_bits.data());
    EXPECT_EQ(windows[1].bits.data(), trace.channel_bits.data() + 2);
    EXPECT_EQ(windows[1].bits.size(), 2u);
    EXPECT_EQ(windows[1].values.data(), trace.values.data() + 12);
    EXPECT_EQ(windows[1].values.size(), 12u);
    EXPECT_TRUE(windows_of(trace, 6).empty());
}

TEST(SquaredDistance, adds_squares_of_continuous_channels_and_differing_bits) {
    Trace const a = trace_of({{0b011, 0.0f}, {0, 0.5f}});
    Trace const b = trace_of({{0b101, 0.5f}, {0, 0.5f}});
    // Step 0: six differences of 0.5, two differing bits; step 1: nothing.
    EXPECT_EQ(squared_distance(collectball_channels(), windows_of(a, 2)[0], windows_of(b, 2)[0]), 6 * 0.25f + 2);
}

TEST(SquaredDistance, ignores_the_thresholded_channels_above_the_binary_ones) {
    Trace const a = trace_of({{0x0000, 0.5f}}), b = trace_of({{0x7E00, 0.5f}});
    EXPECT_EQ(squared_distance(collectball_channels(), windows_of(a, 1)[0], windows_of(b, 1)[0]), 0.0f);
}

TEST(SquaredDistance, is_symmetric_and_near_the_sum_in_double_precision) {
    Stream rng{1, Purpose::test};
    Trace const trace = lore::test::lifelike_trace(rng, 4000);
    std::vector<Window> const windows = windows_of(trace, 20);
    for (std::size_t i = 1; i < windows.size(); ++i) {
        Window const &a = windows[i - 1], &b = windows[i];
        double sum = 0;
        for (std::size_t k = 0; k < a.values.size(); ++k) sum += std::pow(double{a.values[k]} - b.values[k], 2);
        for (std::size_t k = 0; k < a.bits.size(); ++k)
            sum += std::popcount(static_cast<unsigned>((a.bits[k] ^ b.bits[k]) & 0x1FF));
        EXPECT_NEAR(squared_distance(collectball_channels(), a, b), sum, 1e-5 * (1 + sum));
        EXPECT_EQ(squared_distance(collectball_channels(), a, b), squared_distance(collectball_channels(), b, a));
    }
}
