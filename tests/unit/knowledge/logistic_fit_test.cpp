#include "logistic_fit.h"

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace lore;

namespace {

/// Rows of some channels that are continuous, some that are 0 or 1, and a constant, with the targets of a logistic
/// unit.
struct Problem {
    std::vector<double> inputs, targets, bounds;
    LogisticData data() const { return {bounds.size(), inputs, targets}; }
};

Problem problem_of(std::span<double const> theta, std::size_t rows, Stream rng, double noise = 0) {
    Problem problem;
    problem.bounds.assign(theta.size(), 5.0);
    problem.bounds.back() = 25.0;
    for (std::size_t r = 0; r < rows; ++r) {
        double z = 0;
        for (std::size_t j = 0; j < theta.size(); ++j) {
            double const x = j + 1 == theta.size() ? 1.0 : j % 2 == 0 ? rng.uniform() : rng.coin();
            problem.inputs.push_back(x);
            z += theta[j] * x;
        }
        double const y = 1 / (1 + std::exp(-z));
        problem.targets.push_back(std::min(1.0, std::max(0.0, y + rng.uniform(-noise, noise))));
    }
    return problem;
}

}   // namespace

TEST(LogisticFit, of_one_constant_input_gives_the_mean) {
    std::vector<double> const inputs{1, 1, 1, 1}, targets{0, 0, 0, 1}, bounds{25};
    std::vector<double> const theta = fit_logistic({1, inputs, targets}, bounds);
    EXPECT_NEAR(theta[0], -std::log(3.0), 1e-5);   // 1 / (1 + 3) = 1/4
    EXPECT_NEAR(mean_cross_entropy({1, inputs, targets}, theta), -0.25 * std::log(0.25) - 0.75 * std::log(0.75), 1e-6);
    EXPECT_NEAR(mean_absolute_error({1, inputs, targets}, theta), 0.375, 1e-6);
}

TEST(LogisticFit, finds_the_unit_that_made_the_targets) {
    std::vector<double> const theta{1.5, -2, 0.25, 4, -1};
    Problem const problem = problem_of(theta, 500, Stream{1, Purpose::test});
    std::vector<double> const found = fit_logistic(problem.data(), problem.bounds);
    for (std::size_t j = 0; j < theta.size(); ++j) EXPECT_NEAR(found[j], theta[j], 1e-3) << j;
}

TEST(LogisticFit, stops_at_the_bounds_where_targets_can_be_told_apart_exactly) {
    std::vector<double> const inputs{0, 1, 1, 1}, targets{0, 1}, bounds{5, 25};   // rows (0, 1) and (1, 1)
    std::vector<double> const theta = fit_logistic({2, inputs, targets}, bounds);
    EXPECT_EQ(theta[0], 5.0);
    EXPECT_NEAR(theta[1], -2.5, 1e-4);
}

TEST(LogisticFit, leaves_the_weight_of_an_input_that_is_always_0_at_0) {
    std::vector<double> const inputs{0, 1, 0, 1}, targets{0.5, 1}, bounds{5, 25};
    std::vector<double> const theta = fit_logistic({2, inputs, targets}, bounds);
    EXPECT_EQ(theta[0], 0.0);
    EXPECT_NEAR(theta[1], std::log(3.0), 1e-5);
}

TEST(LogisticFit, ends_where_no_parameter_can_gain_whatever_the_pairs) {
    for (std::uint32_t slot = 0; slot < 100; ++slot) {
        Stream rng{2, Purpose::test, 0, slot};
        std::vector<double> theta(2 + rng.below(12));
        for (double& parameter : theta) parameter = rng.uniform(-10, 10);   // half of them beyond the bounds
        Problem const problem = problem_of(theta, 20 + rng.below(300), rng, slot % 2 == 0 ? 0.0 : 0.7);
        std::vector<double> const found = fit_logistic(problem.data(), problem.bounds);
        double const least = mean_cross_entropy(problem.data(), found);
        for (std::size_t j = 0; j < found.size(); ++j) {
            ASSERT_LE(std::abs(found[j]), problem.bounds[j]);
            for (double const step : {-0.01, 0.01}) {
                std::vector<double> other = found;
                other[j] = std::min(problem.bounds[j], std::max(-problem.bounds[j], other[j] + step));
                EXPECT_GE(mean_cross_entropy(problem.data(), other), least - 2e-7) << slot << " " << j;
            }
        }
    }
}

TEST(LogisticFit, takes_the_cross_entropy_of_many_rows_as_the_sum_of_their_logarithms) {
    Problem const problem = problem_of(std::vector<double>{3, -1, 0.5}, 2000, Stream{3, Purpose::test}, 0.3);
    std::vector<double> const theta{-4, 2, 1};
    double sum = 0;
    for (std::size_t r = 0; r < 2000; ++r) {
        double z = 0;
        for (std::size_t j = 0; j < 3; ++j) z += theta[j] * problem.inputs[3 * r + j];
        sum += std::log1p(std::exp(z)) - problem.targets[r] * z;
    }
    EXPECT_NEAR(mean_cross_entropy(problem.data(), theta), sum / 2000, 1e-6);
}
