#include "knowledge/traces.h"

#include <lore/knowledge/builder.h>
#include <lore/knowledge/value.h>

#include <gmock/gmock.h>

#include <cmath>

using namespace lore;
using lore::test::trace_of;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

namespace {

KnowledgeConfig const two_steps = test::config_of(2);

/// Windows of two steps; A, B, C and D are more than the threshold apart (5 bits or more).
constexpr test::Step A0{0x000, 0.5f}, B0{0x01F, 0.5f}, C0{0x1E0, 0.5f}, D0{0x1FF, 0.5f}, end{0x000, 0.5f};

/// The best-of-run (reward 7, of generation 49) shows A, B, A; its parent (4, 10) shows A, C; the founder (0) shows D,
/// B.
Trace const best = trace_of({A0, end, B0, end, A0, end}), parent = trace_of({A0, end, C0, end}),
            the_founder = trace_of({D0, end, B0, end});

Exhibit exhibit_of(Trace const& trace, double reward, std::span<Reward const> rewards = {},
                   std::uint32_t generation = 0) {
    return {windows_of(trace, 2), reward, rewards, generation};
}

std::vector<double> values(KnowledgeBase const& base, ValueConfig const& config) { return values_by(base, config); }

}   // namespace

TEST(DiscountedReturns, of_one_reward_are_gamma_to_the_steps_until_then) {
    Reward const reward[]{{5, 1}};
    std::vector<double> const returns = discounted_returns(reward, 0.5, 2, 4);
    EXPECT_THAT(returns, ElementsAre(1.0 / 32, 1.0 / 8, 1.0 / 2, 0.0));   // windows start at steps 0, 2, 4 and 6
}

TEST(DiscountedReturns, multiply_by_the_amounts_which_may_be_negative) {
    Reward const rewards[]{{1, -0.5f}, {2, 3}};
    EXPECT_THAT(discounted_returns(rewards, 0.5, 2, 2), ElementsAre(-0.25 + 0.75, 3.0));
}

TEST(DiscountedReturns, count_a_reward_in_the_first_step_of_a_window_in_full_and_those_before_not_at_all) {
    Reward const rewards[]{{1, 1}, {4, 1}};
    EXPECT_THAT(discounted_returns(rewards, 0.5, 2, 3), ElementsAre(0.5 + 1.0 / 16, 0.25, 1.0));
    Reward const after_the_last_window[]{{6, 1}};
    EXPECT_THAT(discounted_returns(after_the_last_window, 0.5, 2, 3), ElementsAre(1.0 / 64, 1.0 / 16, 1.0 / 4));
    EXPECT_THAT(discounted_returns({}, 0.5, 2, 2), ElementsAre(0.0, 0.0));
}

TEST(DiscountedReturns, equal_the_sum_of_powers_on_random_rewards) {
    Stream rng{8, Purpose::test};
    for (int round = 0; round < 300; ++round) {
        std::vector<Reward> rewards;
        for (int step = 0; step < 200; ++step)
            if (rng.chance(0.03)) rewards.push_back({step, static_cast<float>(rng.uniform(-1, 2))});
        double const gamma = rng.uniform(0.5, 0.999);
        int const length = 1 + static_cast<int>(rng.below(30));
        std::vector<double> const returns =
            discounted_returns(rewards, gamma, length, static_cast<std::size_t>(200 / length));
        for (std::size_t window = 0; window < returns.size(); ++window) {
            int const start = static_cast<int>(window) * length;
            double sum = 0;
            for (Reward const& reward : rewards)
                if (reward.step >= start) sum += reward.amount * std::pow(gamma, reward.step - start);
            EXPECT_NEAR(returns[window], sum, 1e-12);
        }
    }
}

TEST(Evidence, of_a_lineage_of_three_gives_returns_and_credit_by_hand) {
    KnowledgeBuilder builder{two_steps, make_scan_index(two_steps), {{0.25, 0.5}, true, {}}};
    Reward const by_best[]{{1, 1}, {4, 1}}, by_parent[]{{3, 1}};
    builder.add_individual(exhibit_of(best, 7, by_best));
    builder.add_individual(exhibit_of(parent, 4, by_parent));
    builder.add_individual(exhibit_of(the_founder, 0));
    KnowledgeBase const base = std::move(builder).finish({});   // A, B, C, D
    EXPECT_EQ(base.provenance().value, "mean");

    EXPECT_THAT(base.evidence().showings, ElementsAre(3, 2, 1, 1));
    // gamma 1/2. A: the best's windows at 0 (1/2 + 1/16) and 4 (1), the parent's at 0 (1/8). B: the best's at 2 (1/4)
    // and the founder's (0). C: the parent's at 2 (1/2).
    EXPECT_THAT(values(base, {ValueRule::discounted_return, 0.5}),
                ElementsAre((0.5625 + 1 + 0.125) / 3, 0.25 / 2, 0.5, 0.0));
    EXPECT_THAT(values(base, {ValueRule::discounted_return, 0.25}),
                ElementsAre((0.25 + 1.0 / 256 + 1 + 1.0 / 64) / 3, 1.0 / 16 / 2, 0.25, 0.0));
    // B is new to the best (7 - 4); A and C are new to the parent (4 - 0); D to nobody.
    EXPECT_THAT(base.evidence().news, ElementsAre(1, 1, 1, 0));
    EXPECT_THAT(values(base, {ValueRule::credit, 0}), ElementsAre(4, 3, 4, 0));
    EXPECT_THAT(values(base, {ValueRule::mean, 0}), ElementsAre(5.5, 3.5, 4, 0));
    EXPECT_FALSE(base.evidence().has_contrast());
}

TEST(Evidence, credits_losses_too_and_each_pair_once) {
    // Grandchild (reward 3) shows B twice, its parent (5) A, the founder (1) B.
    Trace const twice = trace_of({B0, end, B0, end}), a = trace_of({A0, end}), b = trace_of({B0, end});
    KnowledgeBuilder builder{two_steps, make_scan_index(two_steps), {{}, true, {}}};
    builder.add_individual(exhibit_of(twice, 3));
    builder.add_individual(exhibit_of(a, 5));
    builder.add_individual(exhibit_of(b, 1));
    KnowledgeBase const base = std::move(builder).finish({});
    EXPECT_THAT(values(base, {ValueRule::credit, 0}), ElementsAre(-2, 4));
    EXPECT_TRUE(base.evidence().showings.empty()) << "no gammas, no returns";
}

TEST(Evidence, contrasts_those_who_succeed_with_those_who_do_not_in_the_same_era) {
    KnowledgeBuilder builder{two_steps, make_scan_index(two_steps), {{}, false, 4}};
    builder.add_individual(exhibit_of(the_founder, 0, {}, 0));
    builder.add_individual(exhibit_of(parent, 4, {}, 10));
    builder.add_individual(exhibit_of(best, 7, {}, 49));
    builder.add_individual(exhibit_of(parent, 0, {}, 50));   // in eras of their own: nobody to be compared with
    builder.add_individual(exhibit_of(the_founder, 9, {}, 100));
    KnowledgeBase const base = std::move(builder).finish({});   // D, B, A, C
    EXPECT_EQ(base.evidence().successes, 2u);
    EXPECT_EQ(base.evidence().failures, 1u);
    EXPECT_THAT(base.evidence().successes_that_showed, ElementsAre(0, 1, 2, 1));
    EXPECT_THAT(base.evidence().failures_that_showed, ElementsAre(1, 1, 0, 0));
    // D: ln(.5/2.5) - ln(1.5/.5) = -ln 15. B: ln(1.5/1.5) - ln 3. A: ln(2.5/.5) - ln(.5/1.5) = ln 15. C: ln 3.
    EXPECT_THAT(values(base, {ValueRule::contrast, 0}),
                ElementsAre(DoubleNear(-std::log(15.0), 1e-12), DoubleNear(-std::log(3.0), 1e-12),
                            DoubleNear(std::log(15.0), 1e-12), DoubleNear(std::log(3.0), 1e-12)));
}

TEST(Evidence, changes_nothing_of_features_values_and_counts_and_is_the_same_in_batches) {
    KnowledgeConfig const config = test::config_of();
    Stream rng{52, Purpose::test};
    std::vector<Trace> traces;
    std::vector<std::vector<Reward>> rewards;
    for (int i = 0; i < 18; ++i) {
        traces.push_back(i % 3 == 2 ? traces[static_cast<std::size_t>(i) - 2] : test::lifelike_trace(rng, 1000));
        auto& of_one = rewards.emplace_back();
        for (int step = 0; step < 1000; ++step)
            if (rng.chance(0.004)) of_one.push_back({step, 1});
    }
    std::vector<Exhibit> exhibits;
    for (std::size_t i = 0; i < traces.size(); ++i)
        exhibits.push_back({windows_of(traces[i], config.window_length), static_cast<double>(rewards[i].size()),
                            rewards[i], static_cast<std::uint32_t>(i * 10)});
    EvidenceConfig const everything{{0.9, 0.99}, true, 4};
    KnowledgeBuilder without{config, make_scan_index(config)}, plain{config, make_scan_index(config), everything},
        batches{config, make_exact_index(config), everything};
    for (Exhibit const& exhibit : exhibits) {
        without.add_individual(exhibit);
        plain.add_individual(exhibit);
    }
    Crew crew{3};
    batches.add_individuals(std::span{exhibits}.first(7), crew);
    batches.add_individuals(std::span{exhibits}.subspan(7), crew);
    KnowledgeBase const bare = std::move(without).finish({}), base = std::move(plain).finish({}),
                        by_batch = std::move(batches).finish({});
    ASSERT_EQ(base.size(), bare.size());
    ASSERT_EQ(base.size(), by_batch.size());
    for (int i = 0; i < base.size(); ++i) {
        ASSERT_EQ(base.value(i), bare.value(i));
        ASSERT_EQ(base.reward_sum(i), bare.reward_sum(i));
        ASSERT_EQ(base.count(i), bare.count(i));
        ASSERT_EQ(squared_distance(config.channels, base.window(i), bare.window(i)), 0.0f);
    }
    EXPECT_GT(base.evidence().successes, 0u);
    for (ValueConfig const rule : {ValueConfig{ValueRule::discounted_return, 0.9},
                                   {ValueRule::discounted_return, 0.99},
                                   {ValueRule::credit, 0},
                                   {ValueRule::contrast, 0}})
        EXPECT_EQ(values(base, rule), values(by_batch, rule)) << text(rule);
}
