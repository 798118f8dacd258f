#pragma once

#include <lore/episode/episode.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lore {

/// Generations whose newborns count as contemporaries: eras are generations 0 .. 49, 50 .. 99 and so on.
inline constexpr int generations_per_era = 50;
inline constexpr std::size_t most_gammas = 16;

/// The evidence that a build gathers of each feature besides the rewards of the individuals that showed it.
struct EvidenceConfig {
    std::vector<double> gammas;   ///< Discounts a step of `returns`, increasing, each in (0, 1); empty: no returns.
    bool credit = false;          ///< Of pairs of child and parent. The builder is then given each individual's parent
                                  ///< right after it, as in a lineage.
    std::optional<double> success_reward;   ///< Of contrast: an individual with so much reward succeeds; none: no
                                            ///< contrast. The builder is then given individuals in order of birth.
};

/// The evidence of a knowledge base beyond reward sums and counts, from which values are derived (knowledge/value.h).
/// Each part is there for all features or for none. A template, so that vectors gather it and spans show it.
template <template <class> class Array>
struct EvidenceParts {
    // Returns, if there are gammas.
    std::vector<double> gammas;
    Array<std::uint64_t> showings;   ///< [feature]: windows that matched it
    /// [gamma][feature]: sum over these showings of the discounted return, sum over t >= 0 of gamma^t times the
    /// reward of step t after the window's first.
    Array<double> return_sums;

    // Credit, if has_credit.
    bool has_credit = false;
    Array<std::uint32_t> news;   ///< [feature]: pairs in which the child showed it and its parent did not
    Array<double> gain_sums;     ///< [feature]: sum over these pairs of the child's reward less the parent's

    // Contrast, if there is a success_reward: individuals of the eras in which some succeeded and some did not.
    std::optional<double> success_reward;
    std::uint64_t successes = 0, failures = 0;    ///< individuals with at least and with less than so much reward
    Array<std::uint32_t> successes_that_showed;   ///< [feature]
    Array<std::uint32_t> failures_that_showed;    ///< [feature]

    bool has_returns() const { return !gammas.empty(); }
    bool has_contrast() const { return success_reward.has_value(); }
    bool none() const { return !has_returns() && !has_credit && !has_contrast(); }
};

template <class T>
using OwnedArray = std::vector<T>;
template <class T>
using ViewedArray = std::span<T const>;
using EvidenceArrays = EvidenceParts<OwnedArray>;
using Evidence = EvidenceParts<ViewedArray>;

Evidence view(EvidenceArrays const&);   ///< valid as long as the arrays

/// For windows 0, 1, 2 ... of `window_length` steps each: sum over the rewards at or after the window's first step of
/// the amount times gamma^(steps from there). `rewards`: in order of steps.
std::vector<double> discounted_returns(std::span<Reward const> rewards, double gamma, int window_length,
                                       std::size_t windows);

}   // namespace lore
