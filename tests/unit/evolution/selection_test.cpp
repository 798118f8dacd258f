#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/evolution/selection.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

using namespace lore;

namespace {

Objectives two(double a, double b) { return {{a, b, 0}, 2}; }

/// Members with the given objectives and crowding distance 0.
std::vector<Individual> members_with(std::vector<Objectives> const& objectives) {
    std::vector<Individual> members;
    for (Objectives const& o : objectives) {
        auto birth = std::make_shared<Birth>();
        birth->id = {3, static_cast<std::uint32_t>(members.size())};
        Individual member;
        member.birth = std::move(birth);
        member.objectives = o;
        members.push_back(std::move(member));
    }
    return members;
}

std::vector<std::uint64_t> rising_keys(std::size_t count) {
    std::vector<std::uint64_t> keys(count);
    for (std::size_t i = 0; i < count; ++i) keys[i] = i;
    return keys;
}

}   // namespace

TEST(TieRule, is_read_by_its_name) {
    for (TieRule const rule : {TieRule::random, TieRule::older, TieRule::younger, TieRule::insertion})
        EXPECT_EQ(tie_rule(name(rule)), rule);
    EXPECT_THROW(tie_rule("oldest"), UsageError);
}

TEST(TieKey, orders_by_birth_where_asked_to) {
    IndividualId const first{2, 199}, second{3, 0}, third{3, 1};
    EXPECT_LT(tie_key(TieRule::older, 1, 9, first), tie_key(TieRule::older, 1, 9, second));
    EXPECT_LT(tie_key(TieRule::older, 1, 9, second), tie_key(TieRule::older, 1, 9, third));
    EXPECT_GT(tie_key(TieRule::younger, 1, 9, first), tie_key(TieRule::younger, 1, 9, second));
    EXPECT_GT(tie_key(TieRule::younger, 1, 9, second), tie_key(TieRule::younger, 1, 9, third));
}

TEST(TieKey, differs_between_individuals_generations_and_seeds) {
    std::set<std::uint64_t> keys;
    for (std::uint64_t seed : {1u, 2u})
        for (int generation : {5, 6})
            for (std::uint32_t birth = 0; birth < 50; ++birth)
                for (std::uint32_t slot = 0; slot < 50; ++slot)
                    keys.insert(tie_key(TieRule::random, seed, generation, {birth, slot}));
    EXPECT_EQ(keys.size(), 2u * 2 * 50 * 50);
}

TEST(TieKey, favors_neither_old_nor_young) {
    int older_first = 0;
    for (int generation = 1; generation <= 4000; ++generation)
        older_first += tie_key(TieRule::random, 7, generation, {0, 3}) <
                       tie_key(TieRule::random, 7, generation, {static_cast<std::uint32_t>(generation), 3});
    EXPECT_NEAR(older_first, 2000, 160);   // five standard deviations
}

TEST(TournamentWinners, let_every_member_take_part_in_exactly_two) {
    // In a strict order the best wins both of its tournaments, the worst none: wins tell which members took part.
    for (int const size : {2, 3, 8, 9, 200, 201}) {
        std::vector<Objectives> ladder;
        for (int i = 0; i < size; ++i) ladder.push_back(two(i, i));
        for (int generation = 1; generation < 20; ++generation) {
            std::vector<int> const winners = tournament_winners(members_with(ladder), size, 5, generation);
            EXPECT_EQ(winners.size(), static_cast<std::size_t>(size));
            EXPECT_EQ(std::count(winners.begin(), winners.end(), size - 1), 2);
            EXPECT_EQ(std::count(winners.begin(), winners.end(), 0), 0);
            for (int i = 0; i < size; ++i) EXPECT_LE(std::count(winners.begin(), winners.end(), i), 2);
        }
    }
}

TEST(TournamentWinners, prefer_the_less_crowded_among_incomparable_ones) {
    std::vector<Individual> members = members_with({two(1, 0), two(0, 1)});
    members[1].crowding = std::numeric_limits<double>::infinity();
    EXPECT_EQ(tournament_winners(members, 2, 1, 1), (std::vector<int>{1, 1}));
    members[0].objectives = two(0, 2);   // now it dominates, and crowding no longer counts
    EXPECT_EQ(tournament_winners(members, 2, 1, 1), (std::vector<int>{0, 0}));
}

TEST(TournamentWinners, toss_a_coin_where_nothing_else_decides) {
    std::vector<Individual> const members = members_with({two(1, 1), two(1, 1)});
    int first = 0;
    for (int generation = 1; generation <= 2000; ++generation)
        for (int const winner : tournament_winners(members, 2, 1, generation)) first += winner == 0;
    EXPECT_NEAR(first, 2000, 160);   // five standard deviations
}

TEST(TournamentWinners, of_a_single_member_are_that_member) {
    EXPECT_EQ(tournament_winners(members_with({two(0, 0)}), 3, 1, 1), (std::vector<int>{0, 0, 0}));
}

TEST(Rank, takes_whole_fronts_and_cuts_the_last_by_crowding) {
    // Front 0: point 0. Front 1: points 1..4 on a line, unevenly spaced; the ends and then 3 are least crowded.
    std::vector<Objectives> const pool{two(9, 9), two(0, 8), two(1, 7), two(3, 5), two(8, 0)};
    Ranking const ranking = rank(pool, rising_keys(5), 4);
    EXPECT_EQ(ranking.fronts, 2);
    EXPECT_EQ(ranking.survivors, (std::vector<int>{0, 1, 4, 3}));
    EXPECT_EQ(ranking.crowding[2], 3 / 8.0 + 3 / 8.0);
    EXPECT_EQ(ranking.crowding[0], 0.0);
}

TEST(Rank, orders_equals_by_tie_key) {
    std::vector<Objectives> const pool(6, two(0, 0.5));
    EXPECT_EQ(rank(pool, std::vector<std::uint64_t>{5, 3, 9, 1, 7, 0}, 3).survivors, (std::vector<int>{5, 3, 1}));
}

TEST(Rank, keeps_everybody_where_there_is_room) {
    std::vector<Objectives> const pool{two(0, 0), two(1, 1)};
    EXPECT_EQ(rank(pool, rising_keys(2), 2).survivors, (std::vector<int>{1, 0}));
    EXPECT_TRUE(rank({}, {}, 0).survivors.empty());
}

TEST(Rank, never_keeps_anyone_dominated_by_someone_it_dropped) {
    Stream rng{31, Purpose::test};
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<Objectives> pool;
        std::vector<std::uint64_t> keys;
        for (int i = 0; i < 40; ++i) {
            pool.push_back(two(rng.below(4), rng.below(6)));
            keys.push_back(rng.bits64());
        }
        Ranking const ranking = rank(pool, keys, 20);
        std::set<int> const kept(ranking.survivors.begin(), ranking.survivors.end());
        ASSERT_EQ(kept.size(), 20u);
        for (int dropped = 0; dropped < 40; ++dropped) {
            if (kept.contains(dropped)) continue;
            for (int const i : kept) EXPECT_FALSE(dominates(pool[dropped], pool[i]));
        }
    }
}

TEST(Rank, cuts_a_small_front_as_an_insertion_sort_leaves_it) {
    // One front; all crowding distances are 0, so that only the order of equals decides.
    std::vector<Objectives> const few(16, two(1, 1)), many(17, two(1, 1));
    std::vector<std::uint64_t> falling(17);
    for (std::size_t i = 0; i < falling.size(); ++i) falling[i] = 100 - i;
    RankingRules const rules{.insertion = true};
    EXPECT_EQ(rank(few, std::span{falling}.first(16), 3, rules).survivors, (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(rank(many, falling, 3, rules).survivors, (std::vector<int>{16, 15, 14})) << "by key in larger fronts";
    EXPECT_EQ(rank(few, std::span{falling}.first(16), 3).survivors, (std::vector<int>{15, 14, 13}));
}

TEST(Rank, parts_two_objectives_by_the_sweep_where_asked_to_and_three_never) {
    std::vector<Objectives> const pairs(3, two(1, 1)), triples(3, Objectives{{1, 1, 1}, 3});
    EXPECT_EQ(rank(pairs, rising_keys(3), 3, {.fronts = FrontsRule::sweep}).fronts, 3);
    EXPECT_EQ(rank(pairs, rising_keys(3), 3).fronts, 1);
    EXPECT_EQ(rank(triples, rising_keys(3), 3, {.fronts = FrontsRule::sweep}).fronts, 1);
}
