#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lore {

/// What a logistic unit y = 1 / (1 + exp(-theta . x)) is to give for each row of inputs.
struct LogisticData {
    std::size_t width = 0;             ///< inputs, and parameters; a constant 1 among them makes an intercept
    std::span<double const> inputs;    ///< [row][width]
    std::span<double const> targets;   ///< [row], in [0, 1]
};

/// Parameters of least mean cross-entropy with |theta_j| <= bounds[j], from theta = 0. The problem is convex: damped
/// Newton steps in the parameters that no bound holds, projected onto the bounds (Bertsekas 1982), some ten of them.
/// A parameter whose input is always 0 stays 0. Sums run in the order of the rows: the same bits on every machine.
std::vector<double> fit_logistic(LogisticData const&, std::span<double const> bounds);

/// Mean of log(1 + exp(z)) - t z, with z = theta . x: -t log y - (1 - t) log(1 - y) without its overflow.
double mean_cross_entropy(LogisticData const&, std::span<double const> theta);
/// Mean of |y - t|.
double mean_absolute_error(LogisticData const&, std::span<double const> theta);

}   // namespace lore
