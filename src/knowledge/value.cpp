#include <lore/knowledge/value.h>

#include <lore/core/error.h>
#include <lore/core/math.h>
#include <lore/core/names.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

constexpr auto rule_names = names_for<ValueRule>("mean", "return", "contrast", "credit");

double log_odds(Shares const& shares) {
    double const showed = static_cast<double>(shares.showed) + 0.5;
    double const others = static_cast<double>(shares.all - shares.showed) + 0.5;
    return math::log(showed / others);
}

[[noreturn]] void refuse_evidence(ValueConfig const& config, std::string const& reason, std::string const& remedy) {
    throw UsageError(fmt::format("value rule {} needs evidence that the base does not have", name(config.rule)), reason,
                     remedy);
}

[[noreturn]] void refuse_lineage(ValueConfig const& config) {
    refuse_evidence(config, "a lineage has no contemporaries", "Build from a run's --all, or --every N of them.");
}

[[noreturn]] void refuse_everybody(ValueConfig const& config) {
    refuse_evidence(config, "it takes pairs of parent and child of a lineage",
                    "Build from the lineage of an individual, without --all.");
}

/// The returns' sums of the wanted gamma.
std::span<double const> return_sums(KnowledgeBase const& base, ValueConfig const& config) {
    Evidence const& evidence = base.evidence();
    if (!evidence.has_returns())
        refuse_evidence(config, "it was built without discounted returns", "Build it anew with 'lore-kb build'.");
    auto const found = std::find(evidence.gammas.begin(), evidence.gammas.end(), config.gamma);
    if (found == evidence.gammas.end())
        refuse_evidence(
            config, fmt::format("it has returns for gamma {}, not {}", fmt::join(evidence.gammas, ", "), config.gamma),
            "Take one of these, or build it anew with --gammas.");
    auto const features = static_cast<std::size_t>(base.size());
    return evidence.return_sums.subspan(static_cast<std::size_t>(found - evidence.gammas.begin()) * features, features);
}

void check_contrast(KnowledgeBase const& base, ValueConfig const& config) {
    Evidence const& evidence = base.evidence();
    std::string const& unit = base.provenance().reward_unit;
    if (!evidence.has_contrast()) refuse_lineage(config);
    if (config.success_reward && *config.success_reward != *evidence.success_reward)
        refuse_evidence(
            config,
            fmt::format("its successes have {} {}, not {}", *evidence.success_reward, unit, *config.success_reward),
            "Leave that out, or build it anew with another --success.");
    if (evidence.successes == 0 || evidence.failures == 0)
        refuse_evidence(config,
                        fmt::format("in no {} generations some individuals got {} {} and some less",
                                    generations_per_era, *evidence.success_reward, unit),
                        "Build it anew with another --success.");
}

}   // namespace

std::string_view name(ValueRule rule) { return rule_names[rule]; }

ValueRule value_rule(std::string_view wanted) {
    if (auto const rule = rule_names.find(wanted)) return *rule;
    throw UsageError(fmt::format("'{}' is no value rule", wanted), "there are " + rule_names.list(),
                     "Take one of these.");
}

double mean_value(double reward_sum, std::uint32_t individuals) { return reward_sum / individuals; }

double return_value(double return_sum, std::uint64_t showings) { return return_sum / static_cast<double>(showings); }

double contrast_value(Shares const& successes, Shares const& failures) {
    return log_odds(successes) - log_odds(failures);
}

double credit_value(double gain_sum, std::uint32_t news) { return news == 0 ? 0.0 : gain_sum / news; }

std::string text(ValueConfig const& config) {
    return config.rule == ValueRule::discounted_return ? fmt::format("return {}", config.gamma)
                                                       : std::string{name(config.rule)};
}

void check_gamma(double gamma) {
    if (!(gamma > 0 && gamma < 1))
        throw UsageError(fmt::format("gamma {} is no discount", gamma), "it lies between 0 and 1, both excluded",
                         "Give one such as 0.995.");
}

ValueConfig value_config(std::string_view rule, std::optional<double> gamma, std::optional<double> success_reward) {
    ValueConfig config;
    config.rule = value_rule(rule);
    if (gamma && config.rule != ValueRule::discounted_return)
        throw UsageError(fmt::format("value rule {} has no gamma", rule), "only return discounts", "Leave it out.");
    if (success_reward && config.rule != ValueRule::contrast)
        throw UsageError(fmt::format("value rule {} has no successes", rule), "only contrast counts them",
                         "Leave that out.");
    config.gamma = gamma.value_or(config.gamma);
    check_gamma(config.gamma);
    if (success_reward && !std::isfinite(*success_reward))
        throw UsageError(fmt::format("a reward of {} makes no success", *success_reward), "it is no finite number",
                         "Correct the number.");
    config.success_reward = success_reward;
    return config;
}

void check_evidence_of(BuiltFrom from, ValueRule rule) {
    if (rule == ValueRule::contrast && from == BuiltFrom::lineage) refuse_lineage({rule});
    if (rule == ValueRule::credit && from == BuiltFrom::everybody) refuse_everybody({rule});
}

std::vector<double> values_by(KnowledgeBase const& base, ValueConfig const& config) {
    Evidence const& evidence = base.evidence();
    std::vector<double> values(static_cast<std::size_t>(base.size()));
    auto const fill = [&](auto const& value_of) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_of(i);
    };
    if (config.rule != ValueRule::mean && evidence.none())
        refuse_evidence(config, "it was built without evidence", "Build it anew with 'lore-kb build'.");
    switch (config.rule) {
    case ValueRule::mean:
        fill([&](std::size_t i) { return mean_value(base.parts().reward_sums[i], base.parts().counts[i]); });
        break;
    case ValueRule::discounted_return: {
        check_gamma(config.gamma);
        std::span<double const> const sums = return_sums(base, config);
        fill([&](std::size_t i) { return return_value(sums[i], evidence.showings[i]); });
        break;
    }
    case ValueRule::contrast:
        check_contrast(base, config);
        fill([&](std::size_t i) {
            return contrast_value({evidence.successes, evidence.successes_that_showed[i]},
                                  {evidence.failures, evidence.failures_that_showed[i]});
        });
        break;
    case ValueRule::credit:
        if (!evidence.has_credit) refuse_everybody(config);
        fill([&](std::size_t i) { return credit_value(evidence.gain_sums[i], evidence.news[i]); });
        break;
    }
    auto const wrong = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
    if (wrong != values.end())
        throw UsageError(
            fmt::format("value rule {} gives {} for feature {}", text(config), *wrong, wrong - values.begin()),
            "values are finite numbers", "Take another rule.");
    return values;
}

KnowledgeBase valued(KnowledgeBase const& base, ValueConfig const& config) {
    Provenance provenance = base.provenance();
    provenance.value = text(config);
    return base.with_values(values_by(base, config), std::move(provenance));
}

}   // namespace lore
