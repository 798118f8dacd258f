#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/evolution/pareto.h>

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(FrontsBySweep, put_equals_of_the_last_front_into_successive_fronts) {
    std::vector<std::uint64_t> const keys{0, 1, 2, 3, 4};
    EXPECT_EQ(fronts_by_sweep(std::vector(3, two(2, 1)), keys), (std::vector<std::vector<int>>{{0}, {1}, {2}}));
    EXPECT_EQ(fronts_by_sweep(std::vector(3, two(2, 1)), std::vector<std::uint64_t>{2, 0, 1}),
              (std::vector<std::vector<int>>{{1}, {2}, {0}}));
    // (3, 1) begins the first front, (2, 0) the second; (1, 1) joins the first, whose latest is not larger than it in
    // the second objective, though (3, 1) dominates it.
    EXPECT_EQ(fronts_by_sweep(std::vector{two(3, 1), two(2, 0), two(1, 1)}, keys),
              (std::vector<std::vector<int>>{{0, 2}, {1}}));
    // Equal points in a front that is not the last share it.
    EXPECT_EQ(fronts_by_sweep(std::vector{two(3, 1), two(2, 0), two(1, 1), two(1, 1), two(0, 0)}, keys),
              (std::vector<std::vector<int>>{{0, 2, 3}, {1}, {4}}));
    EXPECT_TRUE(fronts_by_sweep({}, {}).empty());
}

TEST(FrontsBySweep, are_the_non_dominated_ones_where_no_value_occurs_twice) {
    Stream rng{23, Purpose::test};
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Objectives> points(rng.below(60));
        for (Objectives& point : points) point = two(rng.uniform(), rng.uniform());
        std::vector<std::uint64_t> keys(points.size());
        ASSERT_EQ(fronts_by_sweep(points, keys), non_dominated_fronts_plainly(points)) << "trial " << trial;
    }
}

TEST(FrontsRule, is_read_by_its_name) {
    for (FrontsRule const rule : {FrontsRule::dominance, FrontsRule::sweep}) EXPECT_EQ(fronts_rule(name(rule)), rule);
    EXPECT_THROW(fronts_rule("fast"), UsageError);
}

TEST(CrowdingDistance, gives_ends_to_a_front_of_equals_where_asked_to) {
    std::vector<int> const front{0, 1, 2, 3};
    std::vector<std::uint64_t> const keys{3, 0, 1, 2};
    EXPECT_EQ(crowding_distances(std::vector(4, two(3, 0.5)), front, keys, {.ends_among_equals = true}),
              (std::vector<double>{infinity, infinity, 0, 0}))
        << "the first and the last by tie key";
    // Balls are equal: they give ends, too, to the first and the last by key. Diversity 1 2 | 3 5.
    EXPECT_EQ(crowding_distances(std::vector{two(2, 1), two(2, 3), two(2, 2), two(2, 5)}, front, keys,
                                 {.ends_among_equals = true}),
              (std::vector<double>{infinity, infinity, 2 / 4.0, infinity}));
    EXPECT_EQ(crowding_distances(std::vector{two(3, 0.5)}, std::vector<int>{0}, keys, {.ends_among_equals = true}),
              std::vector<double>{infinity});
}

TEST(CrowdingDistance, leaves_equals_where_an_insertion_sort_leaves_them) {
    std::vector<int> const front{0, 1, 2, 3};
    std::vector<std::uint64_t> const keys{3, 2, 1, 0};   // of no interest
    // By the first objective, falling: 3 | 0 1 2: ends 3 and 2. By the second from there: 0 1 2 | 3: ends 0 and 3.
    std::vector<Objectives> const points{two(0, 1), two(0, 1), two(0, 1), two(1, 0)};
    EXPECT_EQ(crowding_distances(points, front, keys, {.insertion = true}),
              (std::vector<double>{infinity, 0, infinity, infinity}));
    // The order left by the first objective decides in the second: 1 0 | 2 3, then all alike: ends 1 and 3.
    std::vector<Objectives> const alike{two(1, 5), two(2, 5), two(0, 5), two(0, 5)};
    EXPECT_EQ(crowding_distances(alike, front, keys, {.ends_among_equals = true, .insertion = true}),
              (std::vector<double>{1.0, infinity, 0.5, infinity}));
}

TEST(StandsBefore, is_what_stable_sorts_by_one_objective_after_the_other_give) {
    Stream rng{24, Purpose::test};
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<Objectives> points(1 + rng.below(16));
        for (Objectives& point : points) point = three(rng.below(3), rng.below(3), rng.below(3));
        std::vector<int> sorted(points.size()), compared(points.size());
        std::iota(sorted.begin(), sorted.end(), 0);
        std::iota(compared.begin(), compared.end(), 0);
        for (int k = 0; k < 3; ++k) {
            std::stable_sort(sorted.begin(), sorted.end(),
                             [&](int a, int b) { return points[a].value[k] > points[b].value[k]; });
            std::sort(compared.begin(), compared.end(), [&](int a, int b) { return stands_before(points, a, b, k); });
            ASSERT_EQ(sorted, compared);
        }
    }
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
