#include <lore/core/random.h>
#include <lore/evolution/pareto.h>

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

using namespace lore;

namespace {

Objectives two(double a, double b) { return {{a, b, 0}, 2}; }
Objectives three(double a, double b, double c) { return {{a, b, c}, 3}; }

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> crowding_of_all(std::vector<Objectives> const& points) {
    std::vector<int> front(points.size());
    std::iota(front.begin(), front.end(), 0);
    std::vector<std::uint64_t> keys(points.size());
    std::iota(keys.begin(), keys.end(), 0u);
    return crowding_distances(points, front, keys);
}

}   // namespace

TEST(Dominates, asks_for_one_better_and_none_worse) {
    EXPECT_TRUE(dominates(two(1, 2), two(1, 1)));
    EXPECT_TRUE(dominates(two(2, 2), two(1, 1)));
    EXPECT_FALSE(dominates(two(1, 1), two(1, 1)));
    EXPECT_FALSE(dominates(two(2, 0), two(1, 1)));
    EXPECT_FALSE(dominates(two(1, 1), two(1, 2)));
    EXPECT_TRUE(dominates(three(1, 1, 2), three(1, 1, -1)));
}

TEST(NonDominatedFronts, of_a_hand_worked_case) {
    // 2 |     b        a and b trade off, c and d lie behind b, e behind all.
    // 1 |   c   a
    // 0 | e d
    std::vector<Objectives> const points{two(3, 1), two(2, 2), two(1, 1), two(1, 0), two(0, 0)};
    std::vector<std::vector<int>> const expected{{0, 1}, {2}, {3}, {4}};
    EXPECT_EQ(non_dominated_fronts(points), expected);
    EXPECT_EQ(non_dominated_fronts_plainly(points), expected);
}

TEST(NonDominatedFronts, put_equals_into_one_front) {
    std::vector<Objectives> const points{two(0, 1), two(0, 2), two(0, 1), two(0, 2)};
    EXPECT_EQ(non_dominated_fronts(points), (std::vector<std::vector<int>>{{1, 3}, {0, 2}}));
}

TEST(NonDominatedFronts, are_one_where_all_objectives_tie) {
    std::vector<Objectives> const points(5, two(0, 0.25));
    EXPECT_EQ(non_dominated_fronts(points), (std::vector<std::vector<int>>{{0, 1, 2, 3, 4}}));
}

TEST(NonDominatedFronts, of_none_and_of_one) {
    EXPECT_TRUE(non_dominated_fronts({}).empty());
    EXPECT_TRUE(non_dominated_fronts_plainly({}).empty());
    EXPECT_EQ(non_dominated_fronts(std::vector{two(1, 1)}), (std::vector<std::vector<int>>{{0}}));
}

TEST(NonDominatedFronts, equal_the_definition_for_random_points_with_many_ties) {
    Stream rng{21, Purpose::test};
    for (int trial = 0; trial < 400; ++trial) {
        int const count = 1 + static_cast<int>(rng.below(3));
        std::uint32_t const levels = 1 + rng.below(12);
        std::vector<Objectives> points(rng.below(70));
        for (Objectives& point : points) {
            point.count = count;
            for (int k = 0; k < count; ++k) point.value[k] = static_cast<double>(rng.below(levels)) - 1;
        }
        ASSERT_EQ(non_dominated_fronts(points), non_dominated_fronts_plainly(points)) << "trial " << trial;
    }
}

TEST(NonDominatedFronts, equal_the_definition_for_a_pool_as_evolution_has_it) {
    Stream rng{22, Purpose::test};
    std::vector<Objectives> points;
    for (int i = 0; i < 400; ++i) points.push_back(three(rng.below(6), rng.uniform(), rng.below(20) / 19.0));
    EXPECT_EQ(non_dominated_fronts(points), non_dominated_fronts_plainly(points));
}

TEST(CrowdingDistance, of_a_hand_worked_front) {
    // First objective 0 1 2 4 (range 4), second 8 4 2 0 (range 8).
    std::vector<double> const crowding = crowding_of_all({two(1, 4), two(4, 0), two(0, 8), two(2, 2)});
    EXPECT_EQ(crowding, (std::vector<double>{2 / 4.0 + 6 / 8.0, infinity, infinity, 3 / 4.0 + 4 / 8.0}));
}

TEST(CrowdingDistance, is_finite_when_all_share_one_objective_value) {
    // Balls are equal everywhere: only diversity has ends.
    std::vector<double> const crowding = crowding_of_all({two(2, 0.1), two(2, 0.1), two(2, 0.4)});
    EXPECT_EQ(crowding[0], infinity);
    EXPECT_EQ(crowding[1], (0.4 - 0.1) / (0.4 - 0.1));
    EXPECT_EQ(crowding[2], infinity);
}

TEST(CrowdingDistance, is_0_for_everybody_when_all_objectives_tie) {
    EXPECT_EQ(crowding_of_all(std::vector(4, two(3, 0.5))), std::vector<double>(4, 0.0));
    EXPECT_EQ(crowding_of_all({two(3, 0.5)}), std::vector<double>{0.0});
}

TEST(CrowdingDistance, gives_the_ends_among_equals_by_tie_key) {
    std::vector<Objectives> const points{two(0, 1), two(0, 1), two(1, 0), two(1, 0)};
    std::vector<int> const front{0, 1, 2, 3};
    // Ascending by the first objective with keys: 1 0 | 3 2, by the second: 3 2 | 1 0.
    std::vector<std::uint64_t> const keys{9, 2, 8, 1};
    EXPECT_EQ(crowding_distances(points, front, keys), (std::vector<double>{infinity, infinity, infinity, infinity}));
    std::vector<Objectives> const longer{two(0, 1), two(0, 1), two(0, 1), two(1, 0)};
    // First objective 1 2 0 | 3: ends 1 and 3. Second: 3 | 1 2 0: ends 3 and 0. Left: 2, whose neighbors are 1 and 0.
    EXPECT_EQ(crowding_distances(longer, front, std::vector<std::uint64_t>{9, 2, 5, 1}),
              (std::vector<double>{infinity, infinity, 0.0, infinity}));
}

TEST(CrowdingDistance, reads_only_the_members_of_the_front) {
    std::vector<Objectives> const points{two(9, 9), two(0, 2), two(1, 1), two(2, 0)};
    std::vector<std::uint64_t> const keys{0, 1, 2, 3};
    EXPECT_EQ(crowding_distances(points, std::vector<int>{3, 2, 1}, keys),
              (std::vector<double>{infinity, 2.0, infinity}));
    EXPECT_TRUE(crowding_distances(points, {}, keys).empty());
}
