#include "random_descriptors.h"

#include <lore/behavior/distances.h>
#include <lore/core/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace lore;

namespace {

Descriptors path(std::vector<Tile> tiles) {
    Descriptors d;
    d.path = std::move(tiles);
    return d;
}

Descriptors bits(std::vector<std::uint16_t> words, int channels = 15) {
    Descriptors d;
    d.channel_bits = std::move(words);
    d.entropies.resize(static_cast<std::size_t>(channels));
    return d;
}

}   // namespace

TEST(DistanceKind, is_read_by_its_name) {
    for (int k = 0; k < distance_kinds; ++k)
        EXPECT_EQ(distance_kind(name(static_cast<DistanceKind>(k))), static_cast<DistanceKind>(k));
    EXPECT_THROW(distance_kind("haming"), UsageError);
}

TEST(AdhocDistance, is_euclidean_over_all_numbers_of_the_outcome) {
    Descriptors a, b;
    a.outcome = {0, 0, 10};
    b.outcome = {3, 4, 22};
    EXPECT_EQ(adhoc_distance(a, b), 13.0);
    EXPECT_EQ(adhoc_distance(a, a), 0.0);
    EXPECT_EQ(adhoc_distance({}, {}), 0.0) << "worlds without an outcome";
}

TEST(HammingDistance, is_the_fraction_of_differing_bits) {
    EXPECT_EQ(hamming_distance(bits({0b101, 0}), bits({0b110, 0})), 2 / 30.0);
    EXPECT_EQ(hamming_distance(bits({0x7fff, 0x7fff}), bits({0, 0})), 1.0);
}

TEST(HammingDistance, counts_steps_that_only_one_lived_as_wholly_different) {
    EXPECT_EQ(hamming_distance(bits({1}), bits({0, 0, 0})), (1 + 30) / 45.0);
    EXPECT_EQ(hamming_distance(bits({}), bits({5})), 1.0);
    EXPECT_EQ(hamming_distance(bits({}), bits({})), 0.0);
}

TEST(HammingDistance, counts_the_channels_that_there_are) {
    EXPECT_EQ(hamming_distance(bits({1, 0, 1}, 1), bits({0, 0, 1}, 1)), 1 / 3.0);
    // Two steps of 18 channels; then one step that only one lived.
    EXPECT_EQ(hamming_distance(bits({1, 0, 0, 2}, 18), bits({0, 0, 1, 1}, 18)), 4 / 36.0);
    EXPECT_EQ(hamming_distance(bits({1, 0, 0, 2}, 18), bits({1, 1}, 18)), (1 + 18) / 36.0);
}

TEST(TrajectoryDistance, of_a_worked_four_by_four_case_with_a_transposition) {
    // a = P Q R S, b = Q P R T: P and Q change places at the price of one substitution, P for Q: |3-1| + |1-1| = 2
    // twelfths. S becomes T: |5-5| + |2-6| = 4 twelfths. Two substitutions instead of the transposition would cost 4.
    Tile const p{1, 1}, q{3, 1}, r{4, 4}, s{5, 2}, t{5, 6};
    EXPECT_EQ(trajectory_distance(path({p, q, r, s}), path({q, p, r, t})), 6 / 12.0);
    EXPECT_EQ(trajectory_distance(path({p, q, r, s}), path({q, p, r, s})), 2 / 12.0);
    EXPECT_EQ(trajectory_distance(path({p, q}), path({q, p})), 2 / 12.0);
    EXPECT_EQ(trajectory_distance(path({p, r, q}), path({q, r, p})), 4 / 12.0);   // not neighbors: two substitutions
}

TEST(TrajectoryDistance, inserts_and_deletes_at_one_and_substitutes_by_distance) {
    Tile const a{0, 0}, far{11, 7}, near{1, 0};
    EXPECT_EQ(trajectory_distance(path({a}), path({near})), 1 / 12.0);
    EXPECT_EQ(trajectory_distance(path({a}), path({far})), 18 / 12.0);   // cheaper than to delete and insert
    EXPECT_EQ(trajectory_distance(path({a, far}), path({far})), 1.0);
    EXPECT_EQ(trajectory_distance(path({a, a, a, far}), path({far, a, a, a})),
              2.0);   // shifted, not substituted twice (3.0)
    EXPECT_EQ(trajectory_distance(path({}), path({a, a})), 2.0);
    EXPECT_EQ(trajectory_distance(path({}), path({})), 0.0);
}

namespace {

/// The definition read aloud: the cheapest of all ways to undo the ends of both paths.
int cheapest(std::vector<Tile> const& a, std::size_t i, std::vector<Tile> const& b, std::size_t j) {
    if (i == 0) return static_cast<int>(j) * 12;
    if (j == 0) return static_cast<int>(i) * 12;
    int const substitution = std::abs(a[i - 1].x - b[j - 1].x) + std::abs(a[i - 1].y - b[j - 1].y);
    int least = std::min(
        {cheapest(a, i - 1, b, j) + 12, cheapest(a, i, b, j - 1) + 12, cheapest(a, i - 1, b, j - 1) + substitution});
    if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        least = std::min(least, cheapest(a, i - 2, b, j - 2) + substitution);
    return least;
}

}   // namespace

TEST(TrajectoryDistance, is_the_cheapest_of_all_edit_scripts) {
    Stream rng{3, Purpose::test};
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<Tile> a(rng.below(6)), b(rng.below(6));
        for (auto* tiles : {&a, &b})
            for (Tile& tile : *tiles)
                tile = {static_cast<std::uint8_t>(rng.below(2) * 7), static_cast<std::uint8_t>(rng.below(2) * 2)};
        EXPECT_EQ(trajectory_distance(path(a), path(b)), cheapest(a, a.size(), b, b.size()) / 12.0);
    }
}

TEST(EntropyDistance, is_euclidean_over_all_channels) {
    Descriptors a, b;
    a.entropies = {0.3, 0, 0.2};
    b.entropies = {0, 0.4, 0.2};
    EXPECT_EQ(entropy_distance(a, b), 0.5);
}

TEST(Distance, is_symmetric_and_0_for_equal_behaviors) {
    Stream rng{5, Purpose::test};
    for (int trial = 0; trial < 50; ++trial) {
        Descriptors const a = random_behavior(rng, 700), b = random_behavior(rng, 700);
        for (int k = 0; k < distance_kinds; ++k) {
            auto const kind = static_cast<DistanceKind>(k);
            EXPECT_EQ(distance(kind, a, b), distance(kind, b, a));
            EXPECT_EQ(distance(kind, a, a), 0.0);
            EXPECT_GT(distance(kind, a, b), 0.0);
        }
    }
}
