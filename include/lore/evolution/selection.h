#pragma once

#include <lore/evolution/pareto.h>

#include <string_view>

namespace lore {

/// How sorts and cuts order equal individuals (docs/design/model.md). Ties are frequent, since many rewards are
/// discrete.
enum class TieRule : std::uint8_t {
    random,
    older,
    younger,
    insertion   ///< as an insertion sort leaves them in fronts of at most most_inserted members; in others random
};
inline constexpr std::size_t most_inserted = 16;   ///< up to so many, std::sort of libstdc++ is an insertion sort
std::string_view name(TieRule);
TieRule tie_rule(std::string_view name);   ///< throws UsageError

/// The smaller key comes first. random and insertion: from the stream (seed, tie, present generation, id), so that keys
/// change from generation to generation; older, younger: by birth.
std::uint64_t tie_key(TieRule, std::uint64_t seed, int generation, IndividualId);

/// Parents of `count` children by binary tournaments, as indices into `members`.
///
/// Shuffles of the population are laid end to end and cut into pairs, so that every member takes part in exactly two
/// tournaments when count equals the population. In an odd population one pair straddles two shuffles; if it would be
/// the same member twice, the next member takes one place. The winner dominates, else has the larger crowding distance,
/// else a coin decides; objectives and crowding are those of the last joint ranking. Needs a member.
std::vector<int> tournament_winners(std::span<Individual const> members, int count, std::uint64_t seed, int generation);

/// The result of a joint ranking.
struct Ranking {
    std::vector<int> survivors;     ///< indices into the pool, front by front, in a front by crowding then tie key
    std::vector<double> crowding;   ///< of every member of the pool
    int fronts = 0;
};
/// The predecessor's decisions, where they are not Lore's.
struct RankingRules {
    FrontsRule fronts = FrontsRule::dominance;
    bool ends_among_equals = false;   ///< of CrowdingRules
    bool insertion = false;           ///< of CrowdingRules, and where a front is cut; small fronts alone
};
/// Takes whole fronts until one must be cut by crowding distance (Deb et al. 2002). `survivors` is at most the pool's
/// size, and each member has a tie key.
Ranking rank(std::span<Objectives const> pool, std::span<std::uint64_t const> tie_keys, int survivors,
             RankingRules const& = {});

}   // namespace lore
