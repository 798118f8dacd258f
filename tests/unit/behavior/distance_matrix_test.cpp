#include "random_descriptors.h"
#include "support/pointers.h"

#include <lore/behavior/distance_matrix.h>
#include <lore/behavior/mean_distances.h>
#include <lore/core/isa.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <utility>

using namespace lore;
using lore::test::pointers_to;

namespace {

DistanceMatrix three_by_three() {
    DistanceMatrix matrix(3);
    matrix.set(0, 1, 1.0);
    matrix.set(0, 2, 2.0);
    matrix.set(1, 2, 6.0);
    return matrix;
}

DistanceMatrix by_definition(DistanceKind kind, std::vector<Descriptors> const& pool) {
    int const size = static_cast<int>(pool.size());
    DistanceMatrix matrix(size);
    measure_rows_plainly(kind, pointers_to(pool), 0, size, matrix);
    return matrix;
}

/// Every kind, on every instruction set of this machine; of a Euclidean kind also the means.
void expect_fast_equals_plain(std::vector<Descriptors> const& pool, std::vector<DistanceKind> const& kinds) {
    int const size = static_cast<int>(pool.size());
    for (DistanceKind const kind : kinds) {
        DistanceMatrix const plain = by_definition(kind, pool);
        for (int isa = 0; isa <= static_cast<int>(detected_isa()); ++isa) {
            use_isa(static_cast<Isa>(isa));
            DistanceMatrix fast(size);
            measure_rows(kind, pointers_to(pool), 0, size, fast);
            EXPECT_TRUE(fast == plain) << name(kind) << " of " << size << " on " << name(static_cast<Isa>(isa));
            if (!is_euclidean(kind)) continue;
            std::vector<double> means;   // of three ranges
            for (auto const& [first, last] :
                 {std::pair{0, size / 3}, {size / 3, size - size / 4}, {size - size / 4, size}})
                std::ranges::copy(mean_distances(kind, pointers_to(pool), first, last), std::back_inserter(means));
            EXPECT_EQ(means, plain.means()) << name(kind) << " of " << size << " on " << name(static_cast<Isa>(isa));
            EXPECT_EQ(mean_distances(kind, pointers_to(pool)), means);
        }
        use_isa(detected_isa());
    }
}

std::vector<DistanceKind> const all_kinds{DistanceKind::adhoc, DistanceKind::hamming, DistanceKind::trajectory,
                                          DistanceKind::entropy};

}   // namespace

TEST(DistanceMatrix, is_symmetric_with_a_zero_diagonal) {
    DistanceMatrix const matrix = three_by_three();
    EXPECT_EQ(matrix(2, 1), 6.0);
    EXPECT_EQ(matrix(1, 2), 6.0);
    EXPECT_EQ(matrix(1, 1), 0.0);
}

TEST(DistanceMatrix, means_count_the_member_itself) {
    EXPECT_EQ(three_by_three().means(), (std::vector<double>{1.0, 7.0 / 3, 8.0 / 3}));
    EXPECT_EQ(DistanceMatrix(1).means(), std::vector<double>{0.0});
    EXPECT_TRUE(DistanceMatrix{}.means().empty());
}

TEST(DistanceMatrix, selects_in_the_given_order) {
    DistanceMatrix const chosen = three_by_three().select(std::vector<int>{2, 0});
    EXPECT_EQ(chosen.size(), 2);
    EXPECT_EQ(chosen(0, 1), 2.0);
    EXPECT_EQ(chosen(0, 0), 0.0);
}

TEST(DistanceMatrix, keeps_the_old_distances_when_newcomers_join) {
    DistanceMatrix used(7);
    used.set(3, 1, 9.0);
    used.set(4, 2, 9.0);
    for (DistanceMatrix const& spare : {DistanceMatrix{}, DistanceMatrix(3), used}) {
        DistanceMatrix const longer = three_by_three().extended(2, spare);
        EXPECT_EQ(longer.size(), 5);
        EXPECT_EQ(longer.select(std::vector<int>{0, 1, 2}), three_by_three());
    }
}

TEST(DistanceMatrix, sums_and_selects_as_by_definition_for_any_size) {
    Stream rng{12, Purpose::test};
    for (int const size : {1, 2, 7, 8, 9, 16, 17, 40}) {
        DistanceMatrix matrix(size);
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < i; ++j) matrix.set(i, j, rng.uniform() * 1000);
        std::vector<int> members;
        for (int i = 0; i < size; ++i)
            if (i % 3 != 1) members.insert(members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2), i);
        DistanceMatrix const chosen = matrix.select(members);
        std::vector<double> const means = matrix.means();
        for (int i = 0; i < size; ++i) {
            double sum = 0;
            for (int j = 0; j < size; ++j) sum += matrix(i, j);
            EXPECT_EQ(means[i], sum / size) << i << " of " << size;
        }
        for (int i = 0; i < chosen.size(); ++i)
            for (int j = 0; j < chosen.size(); ++j) EXPECT_EQ(chosen(i, j), matrix(members[i], members[j]));
    }
}

TEST(MeasureRows, equals_the_definition_to_the_bit_for_pools_of_any_size) {
    Stream rng{11, Purpose::test};
    for (int const size : {0, 1, 2, 3, 15, 16, 17, 31, 33, 63, 64, 65, 70, 131}) {
        std::vector<Descriptors> pool;
        for (int i = 0; i < size; ++i) pool.push_back(random_behavior(rng, 1000));
        expect_fast_equals_plain(pool, all_kinds);
    }
}

TEST(MeasureRows, equals_the_definition_for_any_channels_and_outcomes) {
    Stream rng{18, Purpose::test};
    for (int const channels : {1, 2, 14, 16, 17, 32, 33, 79, 80}) {
        DescriptorSizes const sizes{static_cast<int>(rng.below(20)), channels};
        SCOPED_TRACE(std::to_string(channels) + " channels, " + std::to_string(sizes.outcome_size) + " outcomes");
        std::vector<Descriptors> alike, different;
        for (int i = 0; i < 20; ++i) alike.push_back(random_behavior(rng, 1100, sizes));
        for (int const steps : {0, 1, 51, 1023, 1024, 1025}) different.push_back(random_behavior(rng, steps, sizes));
        for (int i = 0; i < 20; ++i)
            different.push_back(random_behavior(rng, static_cast<int>(rng.below(2100)), sizes));
        expect_fast_equals_plain(alike, all_kinds);
        expect_fast_equals_plain(different, all_kinds);
    }
}

TEST(MeasureRows, equals_the_definition_for_evaluations_of_full_length) {
    Stream rng{12, Purpose::test};
    std::vector<Descriptors> pool;
    for (int i = 0; i < 40; ++i) pool.push_back(random_behavior(rng, 4000));
    expect_fast_equals_plain(pool, all_kinds);
}

TEST(MeasureRows, counts_more_bits_than_sixteen_bits_can_hold) {
    Stream rng{15, Purpose::test};
    for (int const channels : {3, 15, 16, 33})
        for (int const steps : {4096, 4097, 9000, 30000}) {
            std::vector<Descriptors> pool;
            for (int i = 0; i < 3; ++i) pool.push_back(random_behavior(rng, steps, {0, channels}));
            std::ranges::fill(pool[0].channel_bits, std::uint16_t{0});
            Descriptors const& ones = pool[1];
            for (std::size_t k = 0; k < ones.channel_bits.size(); ++k) {
                int const in_word =
                    std::min(channels - 16 * static_cast<int>(k % static_cast<std::size_t>(ones.words())), 16);
                pool[1].channel_bits[k] = static_cast<std::uint16_t>((1u << in_word) - 1);
            }
            EXPECT_EQ(by_definition(DistanceKind::hamming, pool)(0, 1), 1.0);
            expect_fast_equals_plain(pool, {DistanceKind::hamming});
        }
}

TEST(MeasureRows, equals_the_definition_for_evaluations_of_different_lengths) {
    Stream rng{13, Purpose::test};
    std::vector<Descriptors> pool;
    for (int i = 0; i < 90; ++i) pool.push_back(random_behavior(rng, static_cast<int>(rng.below(2000))));
    pool.push_back(random_behavior(rng, 0));
    pool.push_back(random_behavior(rng, 1));
    pool.push_back(random_behavior(rng, 51));
    expect_fast_equals_plain(pool, all_kinds);
}

TEST(MeasureRows, equals_the_definition_where_behaviors_are_alike) {
    // Children resemble their parents, and many are equal: narrow bands, repeated paths.
    Stream rng{14, Purpose::test};
    std::vector<Descriptors> pool{random_behavior(rng, 4000)};
    for (int i = 1; i < 80; ++i) {
        Descriptors child = pool[rng.below(static_cast<std::uint32_t>(pool.size()))];
        if (rng.coin()) {
            Descriptors const other = random_behavior(rng, 4000);
            std::size_t const turn = rng.below(80);
            std::copy(other.path.begin() + static_cast<std::ptrdiff_t>(turn), other.path.end(),
                      child.path.begin() + static_cast<std::ptrdiff_t>(turn));
            std::copy(other.channel_bits.begin() + static_cast<std::ptrdiff_t>(turn * 50), other.channel_bits.end(),
                      child.channel_bits.begin() + static_cast<std::ptrdiff_t>(turn * 50));
        }
        pool.push_back(std::move(child));
    }
    expect_fast_equals_plain(pool, {DistanceKind::hamming, DistanceKind::trajectory});
}

TEST(MeasureRows, equals_the_definition_for_all_short_paths_over_three_tiles) {
    std::vector<Tile> const alphabet{{0, 0}, {1, 0}, {11, 11}};
    std::vector<Descriptors> pool(1);
    for (std::size_t i = 0; i < pool.size(); ++i) {
        if (pool[i].path.size() == 5) continue;
        for (Tile const tile : alphabet) {
            Descriptors longer = pool[i];
            longer.path.push_back(tile);
            pool.push_back(std::move(longer));
        }
    }
    ASSERT_EQ(pool.size(), 364u);
    expect_fast_equals_plain(pool, {DistanceKind::trajectory});
}

TEST(MeasureRows, equals_the_definition_for_paths_full_of_transpositions) {
    Stream rng{15, Purpose::test};
    std::vector<Descriptors> pool;
    for (int i = 0; i < 100; ++i) {
        Descriptors d;
        for (int k = 0; k < 40; ++k)
            d.path.push_back(
                {static_cast<std::uint8_t>(rng.below(3) * 5), static_cast<std::uint8_t>(rng.below(2) * 11)});
        pool.push_back(std::move(d));
    }
    expect_fast_equals_plain(pool, {DistanceKind::trajectory});
}

TEST(MeasureRows, gives_the_same_whole_for_any_division_into_rows) {
    Stream rng{16, Purpose::test};
    std::vector<Descriptors> pool;
    for (int i = 0; i < 77; ++i) pool.push_back(random_behavior(rng, 1500));
    for (DistanceKind const kind : all_kinds) {
        DistanceMatrix const plain = by_definition(kind, pool);
        DistanceMatrix pieces(77);
        for (auto const& [first, last] : {std::pair{50, 77}, {0, 0}, {0, 1}, {1, 33}, {33, 50}})
            measure_rows(kind, pointers_to(pool), first, last, pieces);
        EXPECT_TRUE(pieces == plain) << name(kind);
    }
}

TEST(MeasureRows, leaves_other_rows_alone) {
    Stream rng{17, Purpose::test};
    std::vector<Descriptors> pool;
    for (int i = 0; i < 6; ++i) pool.push_back(random_behavior(rng, 500));
    for (DistanceKind const kind : all_kinds) {
        DistanceMatrix matrix(6);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) matrix.set(i, j, -1.0);
        measure_rows(kind, pointers_to(pool), 4, 6, matrix);
        EXPECT_EQ(matrix(3, 2), -1.0);
        EXPECT_EQ(matrix(5, 4), distance(kind, pool[5], pool[4]));
    }
}
