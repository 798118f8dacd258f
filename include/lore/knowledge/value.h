#pragma once

#include <lore/knowledge/knowledge_base.h>

#include <optional>
#include <string>
#include <string_view>

namespace lore {

/// How the value of a feature follows from the evidence.
enum class ValueRule : std::uint8_t { mean, discounted_return, contrast, credit };
std::string_view name(ValueRule);              ///< "mean", "return", "contrast", "credit"
ValueRule value_rule(std::string_view name);   ///< throws UsageError

/// The paper: the mean of the rewards of the individuals that showed the feature [reward unit].
double mean_value(double reward_sum, std::uint32_t individuals);

/// The Monte Carlo estimate of a state's value by every visit (Sutton and Barto 2018, section 5.1): the mean over the
/// feature's showings of the discounted return [reward unit].
double return_value(double return_sum, std::uint64_t showings);

/// How many individuals succeed (or do not), and how many of these showed the feature.
struct Shares {
    std::uint64_t all = 0, showed = 0;
};
/// The difference of the log-odds of showing the feature between individuals that succeed and contemporaries that do
/// not:
///     ln((s + 1/2) / (S - s + 1/2)) - ln((f + 1/2) / (F - f + 1/2)),
/// s of S and f of F showed it. The halves keep it finite and nearly without bias (Haldane 1956, Anscombe 1956).
/// Negative where the feature is rarer among those that succeed.
double contrast_value(Shares const& successes, Shares const& failures);

/// The mean gain of the children in which the feature is new: their reward less their parents' [reward unit]. 0 where
/// it never was. Negative where children lose by it.
double credit_value(double gain_sum, std::uint32_t news);

struct ValueConfig {
    ValueRule rule = ValueRule::mean;
    double gamma = 0.995;   ///< Discount a step, in (0, 1). Of discounted_return only.
    std::optional<double> success_reward =
        {};   ///< What makes a success; none: what the base counted. Of contrast only.
    friend bool operator==(ValueConfig const&, ValueConfig const&) = default;
};
/// "mean", "return 0.995", "contrast", "credit": Provenance::value.
std::string text(ValueConfig const&);
/// Throws UsageError unless gamma is in (0, 1).
void check_gamma(double gamma);
/// As users write it: the rule's name, and what they give for it. Throws UsageError: an unknown rule, a number out of
/// range, or one that the rule has no use for.
ValueConfig value_config(std::string_view rule, std::optional<double> gamma, std::optional<double> success_reward);
/// What a base is built from: the ancestors of one individual, or all individuals in order of birth.
enum class BuiltFrom : std::uint8_t { lineage, everybody };
/// Throws UsageError if such a build does not gather the evidence that the rule needs.
void check_evidence_of(BuiltFrom, ValueRule);

/// The values of all features by this rule. Throws UsageError if the base lacks the evidence, or the rule gives a
/// number that is not finite.
std::vector<double> values_by(KnowledgeBase const&, ValueConfig const&);
/// The same features with their values by this rule.
KnowledgeBase valued(KnowledgeBase const&, ValueConfig const&);

}   // namespace lore
