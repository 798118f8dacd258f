#include <lore/world/contract.h>

#include "support/c_worlds.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

namespace lore {
namespace {

using test::trial_world;
using ::testing::HasSubstr;

ContractReport report_of(std::string const& fault, ContractConfig const& config = {8, 200, 1}) {
    return check_contract(
        *trial_world(fault), [&] { return trial_world(fault); }, config);
}

/// The first rule that is broken, "RULE: FINDING".
std::string first_broken(ContractReport const& report) {
    auto const broken = std::ranges::find(report.rules, false, &RuleReport::kept);
    return broken == report.rules.end() ? "" : broken->rule + ": " + broken->finding;
}

TEST(Contract, is_kept_by_a_good_world_and_shows_what_it_does) {
    ContractReport const report = report_of("", {16, 1000, 1});
    EXPECT_TRUE(report.kept()) << first_broken(report);
    EXPECT_EQ(report.rules.size(), 8u);
    EXPECT_EQ(report.sample.lives, 16);
    EXPECT_GT(report.sample.ended, 0) << "lives that hold on";
    EXPECT_LT(report.sample.ended, 16);
    EXPECT_LT(report.sample.least_return, report.sample.most_return);
    EXPECT_TRUE(report.sample.effectors_matter);
    EXPECT_THAT(report.sample.constant_sensors, ::testing::IsEmpty());
}

TEST(Contract, takes_no_more_lives_than_the_world) {
    ContractReport const report = report_of("alone");
    EXPECT_TRUE(report.kept()) << first_broken(report);
    EXPECT_EQ(report.sample.lives, 1);
}

TEST(Contract, names_the_rule_that_a_world_breaks) {
    std::map<std::string, std::string> const told{
        {"nan_sensor", "values: world trial plain from "},
        {"unwritten", "values: "},
        {"counter", "repeatable: life 0: at step 0 sensor 'phase' is "},
        {"sense_moves", "senses: life 0: at step 0 sensor 'phase' is 0.5 the first time and "},
        {"neighbor", "places: life 7: at step 1 sensor 'phase' is "},
        {"batch_size", "company: life 0: at step 0 sensor 'phase' is 0.125 the first time and 1 alone (n = 1)"},
        {"shared", "batches: life 0: at step 1 sensor 'phase' is "},
        {"leftover", "ends: life 0: at step 0 sensor 'phase' is 0.5 the first time and "}};
    for (auto const& [fault, saying] : told) EXPECT_THAT(first_broken(report_of(fault)), HasSubstr(saying)) << fault;
}

#ifndef LORE_SANITIZED   // which keep what is freed
TEST(Contract, finds_memory_that_grows) {
    EXPECT_THAT(first_broken(report_of("leak")), ::testing::MatchesRegex("memory: memory grows by 1[0-9][0-9] bytes a "
                                                                         "batch of 8 lives.*"));
}
#endif

TEST(Contract, is_tried_until_lives_are_over) {
    // Lives that are over for good are given rewards only in batches, and revived ones only after some steps.
    EXPECT_THAT(first_broken(report_of("late_reward", {16, 1000, 1})), HasSubstr("the life was over before"));
    EXPECT_THAT(first_broken(report_of("revives", {8, 200, 1})), HasSubstr("is not over, and was before"));
}

TEST(Speed, is_a_number_of_steps) { EXPECT_GT(measure_speed(*trial_world(), 4, 0.01), 1000); }

}   // namespace
}   // namespace lore
