#include "knowledge/traces.h"
#include "support/complaint.h"

#include <lore/core/random.h>
#include <lore/knowledge/derive.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

/// Two features of one step with all kinds of evidence.
KnowledgeBase two_features() {
    KnowledgeArrays arrays{{0x000, 0x1FF}, std::vector<float>(2 * 6), {2.0, 3.0}, {4.0, 3.0}, {2, 1}};
    arrays.evidence.gammas = {0.5, 0.9};
    arrays.evidence.showings = {4, 1};
    arrays.evidence.return_sums = {1.0, 0.0, 2.0, 0.5};
    arrays.evidence.has_credit = true;
    arrays.evidence.news = {2, 0};
    arrays.evidence.gain_sums = {-3.0, 0.0};
    arrays.evidence.success_reward = 3;
    arrays.evidence.successes = 4;
    arrays.evidence.failures = 4;
    arrays.evidence.successes_that_showed = {4, 2};
    arrays.evidence.failures_that_showed = {0, 2};
    Provenance provenance;
    provenance.kind = "all";
    return KnowledgeBase{test::config_of(1), provenance, std::move(arrays)};
}

std::string complaint(KnowledgeBase const& base, ValueConfig const& config) {
    return test::complaint_of<UsageError>([&] { revalue(base, config); });
}

std::vector<double> values_of(KnowledgeBase const& base) { return {base.values().begin(), base.values().end()}; }

}   // namespace

TEST(ValueRules, are_formulas_of_the_evidence) {
    EXPECT_EQ(mean_value(7, 2), 3.5);
    EXPECT_EQ(return_value(1.5, 3), 0.5);
    EXPECT_EQ(credit_value(-3, 2), -1.5);
    EXPECT_EQ(credit_value(0, 0), 0);
    EXPECT_NEAR(contrast_value({4, 4}, {4, 0}), std::log(81.0), 1e-12);
    EXPECT_EQ(contrast_value({4, 2}, {4, 2}), 0);
}

TEST(ContrastValue, changes_sign_where_success_and_failure_change_places) {
    Stream rng{5, Purpose::test};
    for (int round = 0; round < 300; ++round) {
        Shares const successes{40, rng.below(41)}, failures{60, rng.below(61)};
        EXPECT_TRUE(std::isfinite(contrast_value(successes, failures)));
        EXPECT_EQ(contrast_value(successes, failures), -contrast_value(failures, successes));
    }
}

TEST(Revalue, takes_the_values_from_the_evidence_and_leaves_that_as_it_was) {
    KnowledgeBase const base = two_features();
    EXPECT_THAT(values_of(revalue(base, {ValueRule::discounted_return, 0.5})), ElementsAre(0.25, 0.0));
    EXPECT_THAT(values_of(revalue(base, {ValueRule::discounted_return, 0.9})), ElementsAre(0.5, 0.5));
    EXPECT_THAT(values_of(revalue(base, {ValueRule::credit, 0})), ElementsAre(-1.5, 0.0));
    KnowledgeBase const contrast = revalue(base, {ValueRule::contrast, 0});
    EXPECT_GT(contrast.value(0), contrast.value(1));
    EXPECT_EQ(contrast.provenance().value, "contrast");
    EXPECT_EQ(contrast.provenance().kind, "all");
    EXPECT_THAT(contrast.provenance().derivation, ElementsAre("valued by rule contrast"));
    EXPECT_EQ(values_of(revalue(contrast, {})), values_of(base));
}

TEST(Revalue, finds_the_evidence_again_in_what_was_randomized_permuted_or_reduced) {
    KnowledgeBase const base = two_features();
    ValueConfig const rule{ValueRule::discounted_return, 0.9};
    for (KnowledgeBase const& untrue : {randomize(base, 1), permute(base, 1)}) {
        KnowledgeBase const true_again = revalue(untrue, rule);
        EXPECT_EQ(values_of(true_again), values_of(revalue(base, rule)));
        EXPECT_EQ(true_again.provenance().kind, "revalued");
    }
    KnowledgeBase const second = keep_top(base, 1);   // the feature of value 3
    EXPECT_THAT(values_of(revalue(second, rule)), ElementsAre(0.5));
    EXPECT_THAT(values_of(revalue(second, {ValueRule::discounted_return, 0.5})), ElementsAre(0.0));
    EXPECT_THAT(values_of(revalue(second, {ValueRule::contrast, 0})), ElementsAre(0.0));
}

TEST(Revalue, refuses_what_the_base_does_not_know) {
    KnowledgeBase const bare{test::config_of(1), {}, {{0}, std::vector<float>(6), {2.0}, {4.0}, {2}}};
    for (ValueRule const rule : {ValueRule::discounted_return, ValueRule::contrast, ValueRule::credit})
        EXPECT_THAT(complaint(bare, {rule, 0.9}), HasSubstr("needs evidence that the base does not have"));
    EXPECT_THAT(complaint(two_features(), {ValueRule::discounted_return, 0.7}), HasSubstr("gamma 0.5, 0.9, not 0.7"));
    EXPECT_EQ(complaint(bare, {}), "");
}

TEST(Revalue, refuses_a_gamma_that_does_not_discount) {
    for (double const gamma : {0.0, 1.0, -0.5, 1.5, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THAT(complaint(two_features(), {ValueRule::discounted_return, gamma}), HasSubstr("is no discount"));
}

TEST(Revalue, refuses_values_that_are_no_numbers) {
    KnowledgeArrays arrays{{0}, std::vector<float>(6), {2.0}, {4.0}, {2}};
    arrays.evidence.gammas = {0.5};
    arrays.evidence.showings = {0};   // no file that is read has this
    arrays.evidence.return_sums = {0.0};
    EXPECT_THAT(
        complaint(KnowledgeBase{test::config_of(1), {}, std::move(arrays)}, {ValueRule::discounted_return, 0.5}),
        HasSubstr("nan for feature 0"));
}

TEST(ValueRule, is_known_by_its_name) {
    for (char const* rule : {"mean", "return", "contrast", "credit"}) EXPECT_EQ(name(value_rule(rule)), rule);
    EXPECT_THROW(value_rule("median"), UsageError);
    EXPECT_EQ(text(ValueConfig{ValueRule::discounted_return, 0.995}), "return 0.995");
}
