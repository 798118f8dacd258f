#include <lore/behavior/descriptors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

using namespace lore;

namespace {

/// A world 600 u wide, with a sensor or effector for each letter: b for a binary one, c for a continuous one.
WorldFacts room(std::string const& sensors, std::string const& effectors) {
    WorldFacts facts;
    facts.width = 600;
    facts.height = 400.34f;
    for (char const kind : sensors) facts.sensors.push_back({"s" + std::to_string(facts.sensors.size()), kind == 'b'});
    for (char const kind : effectors)
        facts.effectors.push_back({"e" + std::to_string(facts.effectors.size()), kind == 'b'});
    return facts;
}

/// That of the paper: ranges, what is seen and touched, and effectors.
WorldFacts room() { return room("cccbbbbbbbbb", "ccc"); }

/// A life at rest at the given place; all channels 0.
Trace rest(WorldFacts const& facts, int steps, float x, float y) {
    Trace trace;
    trace.channels = Channels{facts};
    trace.channel_bits.resize(static_cast<std::size_t>(steps * trace.channels.words()));
    trace.values.resize(static_cast<std::size_t>(steps * trace.channels.continuous_count()));
    trace.positions.assign(static_cast<std::size_t>(steps), Position{x, y});
    return trace;
}

Trace rest(int steps, float x, float y) { return rest(room(), steps, x, y); }

}   // namespace

TEST(TileOf, cuts_the_longer_side_in_twelve_square_tiles) {
    EXPECT_EQ(tile_of(room(), 0, 0), (Tile{0, 0}));
    EXPECT_EQ(tile_of(room(), 49.9f, 50), (Tile{0, 1}));
    EXPECT_EQ(tile_of(room(), 599.9f, 400), (Tile{11, 8}));
    WorldFacts upright = room();
    std::swap(upright.width, upright.height);
    EXPECT_EQ(tile_of(upright, 400, 599.9f), (Tile{8, 11}));
}

TEST(TileOf, puts_the_far_edge_in_the_last_tile) {
    WorldFacts square = room();
    square.width = square.height = 3;
    EXPECT_EQ(tile_of(square, 3, 0), (Tile{11, 0}));
    EXPECT_EQ(tile_of(square, 0, 3), (Tile{0, 11}));
    EXPECT_EQ(tile_of(room(), 600, 400.34f), (Tile{11, 8}));
}

TEST(EntropyBin, puts_both_ends_of_the_range_in_a_bin) {
    EXPECT_EQ(entropy_bin(0.0f), 0);
    EXPECT_EQ(entropy_bin(0.1f), 0);      // 0.999
    EXPECT_EQ(entropy_bin(0.1002f), 1);   // 1.001
    EXPECT_EQ(entropy_bin(1.0f), entropy_bins - 1);
}

TEST(Entropies, are_0_where_one_bin_holds_all_and_1_where_all_bins_hold_the_same) {
    Channels const channels{room()};
    ChannelHistograms histograms{channels};
    for (auto& bins : histograms.continuous) bins[3] = 4000;
    histograms.continuous[0].fill(400);
    histograms.ones = {0, 4000, 2000, 0, 0, 0, 0, 0, 0};
    auto const result = entropies(channels, histograms, 4000);
    EXPECT_NEAR(result[0], 1.0, 1e-15);
    EXPECT_EQ(result[1], 0.0);
    EXPECT_EQ(result[3], 0.0);
    EXPECT_EQ(result[4], 0.0);
    EXPECT_NEAR(result[5], 1.0, 1e-15);
    EXPECT_EQ(result[14], 0.0);
}

TEST(Entropies, of_one_in_four_are_those_of_the_textbook) {
    Channels const channels{room()};
    ChannelHistograms histograms{channels};
    for (auto& bins : histograms.continuous) bins[0] = 8;
    histograms.continuous[5] = {2, 6, 0, 0, 0, 0, 0, 0, 0, 0};
    histograms.ones[8] = 2;
    auto const result = entropies(channels, histograms, 8);
    double const bits = 0.25 * std::log2(4) + 0.75 * std::log2(4.0 / 3.0);
    EXPECT_NEAR(result[11], bits, 1e-15);
    EXPECT_NEAR(result[14], bits / std::log2(10), 1e-15);
}

TEST(Entropies, of_an_evaluation_longer_than_the_table_of_logarithms_agree) {
    Channels const channels{room()};
    ChannelHistograms histograms{channels};
    for (auto& bins : histograms.continuous) bins[0] = 100000;
    histograms.ones[0] = 25000;
    EXPECT_NEAR(entropies(channels, histograms, 100000)[3], 0.811278124459133, 1e-14);
}

TEST(Entropies, of_no_steps_are_0) {
    Channels const channels{room("bc", "b")};
    EXPECT_EQ(entropies(channels, ChannelHistograms{channels}, 0), (std::vector<double>{0, 0, 0}));
}

TEST(Entropies, of_channels_of_one_kind_alone_are_those_of_all_channels) {
    Channels const binary{room("b", "b")}, continuous{room("c", "c")};
    ChannelHistograms of_binary{binary}, of_continuous{continuous};
    of_binary.ones = {4, 8};
    for (std::size_t bin = 0; bin < 2; ++bin) of_continuous.continuous[1][bin] = 4;
    of_continuous.continuous[0][0] = 8;
    auto result = entropies(binary, of_binary, 8);
    ASSERT_EQ(result.size(), 2u);
    EXPECT_NEAR(result[0], 1.0, 1e-15);
    EXPECT_EQ(result[1], 0.0);
    result = entropies(continuous, of_continuous, 8);
    ASSERT_EQ(result.size(), 2u);
    EXPECT_EQ(result[0], 0.0);
    EXPECT_NEAR(result[1], std::log10(2.0), 1e-15);
}

TEST(Describe, samples_the_path_every_fifty_steps_from_the_first) {
    Trace trace = rest(101, 25, 25);
    trace.positions[50] = {75, 25};
    trace.positions[99] = {599, 25};
    trace.positions[100] = {25, 75};
    EXPECT_EQ(describe(room(), trace).path, (std::vector<Tile>{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(Describe, keeps_the_hamming_bits_and_the_outcome) {
    Trace trace = rest(3, 25, 25);
    trace.channel_bits = {1, 2, 0x7fff};
    trace.outcome = {1, -2, 3.5f};
    Descriptors const d = describe(room(), trace);
    EXPECT_EQ(d.channel_bits, trace.channel_bits);
    EXPECT_EQ(d.outcome, trace.outcome);
    EXPECT_EQ(d.channels(), 15);
    EXPECT_EQ(d.words(), 1);
    EXPECT_EQ(d.steps(), 3);
}

TEST(Describe, counts_channels_in_the_order_of_the_interface) {
    Trace trace = rest(2, 25, 25);
    trace.channel_bits[0] = 1;    // the first binary channel is channel 3
    trace.values[6 + 5] = 1.0f;   // the last continuous channel is channel 14
    auto const entropy = describe(room(), trace).entropies;
    ASSERT_EQ(entropy.size(), 15u);
    EXPECT_EQ(entropy[3], 1.0);
    EXPECT_NEAR(entropy[14], std::log10(2.0), 1e-15);
    for (std::size_t c : {0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}) EXPECT_EQ(entropy[c], 0.0) << c;
}

TEST(Describe, reads_binary_channels_beyond_the_first_word) {
    WorldFacts const facts = room("cbbbbbbbbbbbbbbbbb", "b");   // 18 binary channels, from channel 1
    Trace trace = rest(facts, 2, 25, 25);
    ASSERT_EQ(trace.channels.words(), 2);
    trace.channel_bits = {0, 0, 1u << 15, 1u << 1};   // of the second step: binary channels 15 and 17
    Descriptors const d = describe(facts, trace);
    EXPECT_EQ(d.steps(), 2);
    std::vector<double> expected(19, 0.0);
    expected[16] = expected[18] = 1.0;
    EXPECT_EQ(d.entropies, expected);
}
