#include <lore/evolution/selection.h>

#include <lore/core/names.h>
#include <lore/core/random.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

namespace lore {

namespace {

constexpr auto rule_names = names_for<TieRule>("random", "older", "younger", "insertion");

/// Shuffles of 0 .. members-1 laid end to end, at least `length` long, in which no pair (2k, 2k+1) is one member twice
/// (unless there is only one).
std::vector<int> tournament_draw(int members, int length, Stream& rng) {
    std::vector<int> draw;
    std::vector<int> shuffle(static_cast<std::size_t>(members));
    std::iota(shuffle.begin(), shuffle.end(), 0);
    while (static_cast<int>(draw.size()) < length) {
        rng.shuffle(std::span{shuffle});
        bool const straddles = draw.size() % 2 == 1;
        if (straddles && draw.back() == shuffle[0] && members > 1) std::swap(shuffle[0], shuffle[1]);
        draw.insert(draw.end(), shuffle.begin(), shuffle.end());
    }
    return draw;
}

}   // namespace

std::string_view name(TieRule rule) { return rule_names[rule]; }

TieRule tie_rule(std::string_view wanted) { return rule_names.choice(wanted, "a rule for ties"); }

std::uint64_t tie_key(TieRule rule, std::uint64_t seed, int generation, IndividualId id) {
    std::uint64_t const by_birth = (static_cast<std::uint64_t>(id.generation) << 32) | id.slot;
    switch (rule) {
    case TieRule::older: return by_birth;
    case TieRule::younger: return ~by_birth;
    case TieRule::random:
    case TieRule::insertion: break;
    }
    // The stream's counter has one word for the id, which has two: the generation of birth goes to its upper half. Two
    // ids share a counter, and so a key, only beyond 65 536 slots or generations.
    std::uint32_t const who = std::rotl(id.generation, 16) ^ id.slot;
    return Stream{seed, Purpose::tie, static_cast<std::uint32_t>(generation), who}.bits64();
}

std::vector<int> tournament_winners(std::span<Individual const> members, int count, std::uint64_t seed,
                                    int generation) {
    assert(!members.empty());
    Stream rng{seed, Purpose::tournament, static_cast<std::uint32_t>(generation)};
    std::vector<int> const draw = tournament_draw(static_cast<int>(members.size()), 2 * count, rng);
    std::vector<int> winners;
    winners.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
        int const a = draw[2 * k], b = draw[2 * k + 1];
        Individual const &first = members[a], &second = members[b];
        bool first_wins;
        if (dominates(first.objectives, second.objectives)) first_wins = true;
        else if (dominates(second.objectives, first.objectives)) first_wins = false;
        else if (first.crowding != second.crowding) first_wins = first.crowding > second.crowding;
        else first_wins = rng.coin();
        winners.push_back(first_wins ? a : b);
    }
    return winners;
}

Ranking rank(std::span<Objectives const> pool, std::span<std::uint64_t const> tie_keys, int survivors,
             RankingRules const& rules) {
    assert(pool.size() == tie_keys.size() && survivors <= static_cast<int>(pool.size()));
    Ranking ranking;
    ranking.crowding.resize(pool.size());
    bool const sweeps = rules.fronts == FrontsRule::sweep && !pool.empty() && pool.front().count == 2;
    std::vector<std::vector<int>> fronts = sweeps ? fronts_by_sweep(pool, tie_keys) : non_dominated_fronts(pool);
    ranking.fronts = static_cast<int>(fronts.size());
    for (std::vector<int>& front : fronts) {
        bool const inserts = rules.insertion && front.size() <= most_inserted;
        std::vector<double> const crowding =
            crowding_distances(pool, front, tie_keys, {rules.ends_among_equals, inserts});
        for (std::size_t place = 0; place < front.size(); ++place) ranking.crowding[front[place]] = crowding[place];
        std::size_t const room = static_cast<std::size_t>(survivors) - ranking.survivors.size();
        if (room == 0) continue;
        std::sort(front.begin(), front.end(), [&](int a, int b) {
            if (ranking.crowding[a] != ranking.crowding[b]) return ranking.crowding[a] > ranking.crowding[b];
            if (inserts) return stands_before(pool, a, b, pool[a].count - 1);
            if (tie_keys[a] != tie_keys[b]) return tie_keys[a] < tie_keys[b];
            return a < b;
        });
        std::size_t const taken = std::min(room, front.size());
        ranking.survivors.insert(ranking.survivors.end(), front.begin(),
                                 front.begin() + static_cast<std::ptrdiff_t>(taken));
    }
    return ranking;
}

}   // namespace lore
