#include <lore/statistics/mann_whitney.h>

#include <lore/core/error.h>
#include <lore/core/random.h>
#include <statistics/reference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace lore;
using Sample = std::vector<double>;

TEST(MannWhitney, agrees_with_scipy_with_and_without_ties) {
    auto const cases = test::reference_cases();
    ASSERT_GE(cases.size(), 16u);
    for (auto const& reference : cases) {
        MannWhitney const ours = mann_whitney(reference.first, reference.second);
        EXPECT_EQ(ours.u, reference.u);
        EXPECT_EQ(ours.exact, reference.exact);
        EXPECT_NEAR(ours.p, reference.p, 1e-12 + 1e-9 * reference.p);
    }
}

TEST(MannWhitney, counts_two_of_twenty_arrangements_where_three_values_lie_below_three_others) {
    MannWhitney const test = mann_whitney(Sample{1, 2, 3}, Sample{4, 5, 6});
    EXPECT_EQ(test.u, 0);
    EXPECT_TRUE(test.exact);
    EXPECT_NEAR(test.p, 2.0 / 20, 1e-15);   // U = 0 or U = 9
}

TEST(MannWhitney, says_one_where_all_values_are_equal) {
    MannWhitney const test = mann_whitney(Sample(30, 4), Sample(12, 4));
    EXPECT_EQ(test.u, 30 * 12 / 2);
    EXPECT_EQ(test.p, 1);
    EXPECT_FALSE(test.exact);
}

TEST(MannWhitney, says_one_for_two_single_values) {
    EXPECT_EQ(mann_whitney(Sample{1}, Sample{2}).p, 1);
    EXPECT_EQ(mann_whitney(Sample{2}, Sample{2}).p, 1);
}

TEST(MannWhitney, refuses_an_empty_sample_and_one_with_a_nan) {
    EXPECT_THROW(mann_whitney(Sample{}, Sample{1}), Error);
    EXPECT_THROW(mann_whitney(Sample{1}, Sample{}), Error);
    EXPECT_THROW(mann_whitney(Sample{1, std::numeric_limits<double>::quiet_NaN()}, Sample{1}), Error);
    EXPECT_THROW(vargha_delaney_a12(Sample{}, Sample{1}), Error);
}

TEST(MannWhitney, is_symmetric_for_random_samples_with_ties) {
    Stream rng{5, Purpose::test};
    for (int trial = 0; trial < 300; ++trial) {
        Sample a(1 + rng.below(20)), b(1 + rng.below(20));
        for (double& x : a) x = rng.below(8);
        for (double& x : b) x = rng.below(8);
        MannWhitney const ab = mann_whitney(a, b), ba = mann_whitney(b, a);
        EXPECT_EQ(ab.p, ba.p);
        EXPECT_EQ(ab.u + ba.u, static_cast<double>(a.size() * b.size()));
        EXPECT_GE(ab.p, 0);
        EXPECT_LE(ab.p, 1);
    }
}

TEST(MannWhitney, has_exact_and_normal_forms_that_nearly_agree_just_around_the_limit) {
    // The same shifted samples with 100 values each (exact) and with one more (normal): the jump must be small.
    Sample a, b;
    for (int i = 0; i < exact_sample_limit; ++i) {
        a.push_back(i * 2);
        b.push_back(i * 2 + 25.5);
    }
    MannWhitney const exact = mann_whitney(a, b);
    a.push_back(100.25);
    MannWhitney const normal = mann_whitney(a, b);
    EXPECT_TRUE(exact.exact);
    EXPECT_FALSE(normal.exact);
    EXPECT_NEAR(exact.p, normal.p, 0.2 * exact.p);
}

TEST(VarghaDelaney, is_the_share_of_pairs_won_with_ties_counting_half) {
    EXPECT_EQ(vargha_delaney_a12(Sample{1, 2}, Sample{3, 4}), 0);
    EXPECT_EQ(vargha_delaney_a12(Sample{3, 4}, Sample{1, 2}), 1);
    EXPECT_EQ(vargha_delaney_a12(Sample{1, 1}, Sample{1}), 0.5);
    EXPECT_EQ(vargha_delaney_a12(Sample{1, 3}, Sample{2, 3}), (1 + 0.5) / 4);
}
