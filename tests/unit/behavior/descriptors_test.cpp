#include <lore/behavior/descriptors.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace lore;

namespace {

Arena room() {
    Arena arena;
    arena.width = 600;
    arena.height = 400.34f;
    arena.task.ball_positions = {{100, 100}, {200, 200}};
    return arena;
}

/// A robot that rests at the given place; all channels 0.
Trace rest(int steps, float x, float y) {
    Trace trace;
    trace.channel_bits.assign(static_cast<std::size_t>(steps), 0);
    trace.values.assign(static_cast<std::size_t>(steps) * continuous_count, 0.0f);
    trace.poses.assign(static_cast<std::size_t>(steps), Pose{x, y, 0});
    return trace;
}

}   // namespace

TEST(TileOf, cuts_the_longer_side_in_twelve_square_tiles) {
    EXPECT_EQ(tile_of(room(), 0, 0), (Tile{0, 0}));
    EXPECT_EQ(tile_of(room(), 49.9f, 50), (Tile{0, 1}));
    EXPECT_EQ(tile_of(room(), 599.9f, 400), (Tile{11, 8}));
    Arena upright = room();
    std::swap(upright.width, upright.height);
    EXPECT_EQ(tile_of(upright, 400, 599.9f), (Tile{8, 11}));
}

TEST(EntropyBin, puts_both_ends_of_the_range_in_a_bin) {
    EXPECT_EQ(entropy_bin(0.0f), 0);
    EXPECT_EQ(entropy_bin(0.1f), 0);      // 0.999
    EXPECT_EQ(entropy_bin(0.1002f), 1);   // 1.001
    EXPECT_EQ(entropy_bin(1.0f), entropy_bins - 1);
}

TEST(Entropies, are_0_where_one_bin_holds_all_and_1_where_all_bins_hold_the_same) {
    ChannelHistograms histograms;
    for (auto& bins : histograms.continuous) bins[3] = 4000;
    histograms.continuous[0].fill(400);
    histograms.ones = {0, 4000, 2000, 0, 0, 0, 0, 0, 0};
    auto const result = entropies(histograms, 4000);
    EXPECT_NEAR(result[0], 1.0, 1e-15);
    EXPECT_EQ(result[1], 0.0);
    EXPECT_EQ(result[3], 0.0);
    EXPECT_EQ(result[4], 0.0);
    EXPECT_NEAR(result[5], 1.0, 1e-15);
    EXPECT_EQ(result[14], 0.0);
}

TEST(Entropies, of_one_in_four_are_those_of_the_textbook) {
    ChannelHistograms histograms;
    for (auto& bins : histograms.continuous) bins[0] = 8;
    histograms.continuous[5] = {2, 6, 0, 0, 0, 0, 0, 0, 0, 0};
    histograms.ones[8] = 2;
    auto const result = entropies(histograms, 8);
    double const bits = 0.25 * std::log2(4) + 0.75 * std::log2(4.0 / 3.0);
    EXPECT_NEAR(result[11], bits, 1e-15);
    EXPECT_NEAR(result[14], bits / std::log2(10), 1e-15);
}

TEST(Entropies, of_an_evaluation_longer_than_the_table_of_logarithms_agree) {
    ChannelHistograms histograms;
    for (auto& bins : histograms.continuous) bins[0] = 100000;
    histograms.ones[0] = 25000;
    EXPECT_NEAR(entropies(histograms, 100000)[3], 0.811278124459133, 1e-14);
}

TEST(Entropies, of_no_steps_are_0) { EXPECT_EQ(entropies({}, 0), (std::array<double, channel_count>{})); }

TEST(Describe, samples_the_path_every_fifty_steps_from_the_first) {
    Trace trace = rest(101, 25, 25);
    trace.poses[50] = {75, 25, 0};
    trace.poses[99] = {599, 25, 0};
    trace.poses[100] = {25, 75, 0};
    EXPECT_EQ(describe(room(), trace).path, (std::vector<Tile>{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(Describe, keeps_the_hamming_bits_and_the_places_of_the_tasks_balls) {
    Trace trace = rest(3, 25, 25);
    trace.channel_bits = {1, 2, 0x7fff};
    trace.final_world.released[0] = {1, 2};
    trace.final_world.released[1] = {3, 4};
    trace.final_world.released[2] = {5, 6};   // the task has two balls
    Descriptors const d = describe(room(), trace);
    EXPECT_EQ(d.channel_bits, trace.channel_bits);
    EXPECT_EQ(d.ball_positions, (std::vector<Point>{{1, 2}, {3, 4}}));
}

TEST(Describe, counts_channels_in_the_order_of_the_interface) {
    Trace trace = rest(2, 25, 25);
    trace.channel_bits[0] = 1;                   // the first binary channel is channel 3
    trace.values[continuous_count + 5] = 1.0f;   // the last continuous channel is channel 14
    auto const entropy = describe(room(), trace).entropies;
    EXPECT_EQ(entropy[3], 1.0);
    EXPECT_NEAR(entropy[14], std::log10(2.0), 1e-15);
    for (int c : {0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}) EXPECT_EQ(entropy[c], 0.0) << channel_names[c];
}
