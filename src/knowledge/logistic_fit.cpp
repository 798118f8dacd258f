#include "logistic_fit.h"

#include <lore/core/math.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace lore {

namespace {

constexpr int most_steps = 50;
constexpr double flat_enough = 1e-6;   ///< slope at which exp's own error (2 ulp of a float) would decide
constexpr double damping = 1e-8;       ///< added to the curvature: an input that is always 0 has none
constexpr double least_gain = 1e-4;    ///< share of the descent that the slope promises (Armijo)
constexpr double shortest_step = 1e-3;

struct Unit {
    double y;
    double tail;   ///< exp(-|z|)
};

Unit unit_at(double z) {
    double const tail = math::exp(static_cast<float>(-std::abs(z)));
    return {(z < 0 ? tail : 1.0) / (1.0 + tail), tail};
}

double dot(double const* row, std::span<double const> theta) {
    double sum = 0;
    for (std::size_t j = 0; j < theta.size(); ++j) sum += row[j] * theta[j];
    return sum;
}

/// Sum of log(1 + tail): one logarithm for many factors, each of them at most 2.
class SumOfLogs {
public:
    void add(double tail) {
        product_ *= 1.0 + tail;
        if (++factors_ % 512 == 0) flush();
    }
    double total() {
        flush();
        return total_;
    }

private:
    void flush() {
        total_ += math::log(product_);
        product_ = 1;
    }
    double product_ = 1, total_ = 0;
    int factors_ = 0;
};

/// Mean cross-entropy at theta with its derivatives.
struct Slope {
    std::vector<double> theta;
    double value = 0;
    std::vector<double> gradient;    ///< [width]
    std::vector<double> curvature;   ///< [width][width], the lower triangle
};

Slope slope_at(LogisticData const& data, std::vector<double> theta) {
    std::size_t const width = data.width, rows = data.targets.size();
    Slope slope{std::move(theta), 0, std::vector<double>(width), std::vector<double>(width * width)};
    SumOfLogs logs;
    double linear = 0;   // of the cross-entropy
    for (std::size_t r = 0; r < rows; ++r) {
        double const* const x = data.inputs.data() + r * width;
        double const z = dot(x, slope.theta), target = data.targets[r];
        auto const [y, tail] = unit_at(z);
        logs.add(tail);
        linear += std::max(z, 0.0) - target * z;
        double const weight = y * (1.0 - y);
        for (std::size_t i = 0; i < width; ++i) {
            if (x[i] == 0) continue;   // most binary channels are
            slope.gradient[i] += (y - target) * x[i];
            double const weighted = weight * x[i];
            double* const curvature = slope.curvature.data() + i * width;
            for (std::size_t j = 0; j <= i; ++j) curvature[j] += weighted * x[j];
        }
    }
    double const scale = 1.0 / static_cast<double>(rows);
    slope.value = (linear + logs.total()) * scale;
    for (double& g : slope.gradient) g *= scale;
    for (double& c : slope.curvature) c *= scale;
    return slope;
}

/// Whether a step of this sign would leave the bounds at once.
bool is_held(double theta, double bound, double direction) {
    return (theta >= bound && direction > 0) || (theta <= -bound && direction < 0);
}

/// Solves (curvature + damping) step = -gradient among the free parameters by Cholesky's L D L^T; the others stay.
std::vector<double> newton_step(Slope const& slope, std::vector<std::size_t> const& free) {
    std::size_t const n = free.size(), width = slope.theta.size();
    std::vector<double> l(n * n), d(n), solution(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = slope.curvature[free[i] * width + free[j]] + (i == j ? damping : 0.0);
            for (std::size_t k = 0; k < j; ++k) sum -= l[i * n + k] * d[k] * l[j * n + k];
            if (i == j) d[i] = std::max(sum, damping);
            else l[i * n + j] = sum / d[j];
        }
        solution[i] = -slope.gradient[free[i]];
        for (std::size_t k = 0; k < i; ++k) solution[i] -= l[i * n + k] * solution[k];
    }
    std::vector<double> step(width, 0.0);
    for (std::size_t i = n; i-- > 0;) {
        solution[i] /= d[i];
        for (std::size_t k = i + 1; k < n; ++k) solution[i] -= l[k * n + i] * solution[k];
        step[free[i]] = solution[i];
    }
    return step;
}

/// Where the step, shortened until it keeps what the slope promises and cut off at the bounds, leads to.
std::optional<Slope> go(LogisticData const& data, Slope const& from, std::vector<double> const& step,
                        std::span<double const> bounds) {
    for (double length = 1; length >= shortest_step; length /= 2) {
        std::vector<double> theta = from.theta;
        double promised = 0;
        for (std::size_t j = 0; j < theta.size(); ++j) {
            theta[j] = std::clamp(theta[j] + length * step[j], -bounds[j], bounds[j]);
            promised += from.gradient[j] * (theta[j] - from.theta[j]);
        }
        Slope to = slope_at(data, std::move(theta));
        if (promised < 0 && to.value <= from.value + least_gain * promised) return to;
    }
    return std::nullopt;
}

/// The Newton step in the parameters that are free to take it.
std::vector<double> free_step(Slope const& slope, std::vector<std::size_t> free, std::span<double const> bounds) {
    for (;;) {
        std::vector<double> step = newton_step(slope, free);
        // Cut off at a bound, a component could turn the rest of the step uphill; it is held for this step instead.
        auto const held = [&](std::size_t j) { return is_held(slope.theta[j], bounds[j], step[j]); };
        if (std::erase_if(free, held) == 0) return step;
    }
}

}   // namespace

std::vector<double> fit_logistic(LogisticData const& data, std::span<double const> bounds) {
    Slope slope = slope_at(data, std::vector<double>(data.width, 0.0));
    for (int steps = 0; steps < most_steps; ++steps) {
        std::vector<std::size_t> free;
        std::vector<double> downhill(data.width, 0.0);
        double steepest = 0;
        for (std::size_t j = 0; j < data.width; ++j) {
            if (is_held(slope.theta[j], bounds[j], -slope.gradient[j])) continue;
            free.push_back(j);
            steepest = std::max(steepest, std::abs(slope.gradient[j]));
            downhill[j] = -slope.gradient[j] / (slope.curvature[j * data.width + j] + damping);
        }
        if (steepest < flat_enough) break;
        std::optional<Slope> next = go(data, slope, free_step(slope, free, bounds), bounds);
        if (!next) next = go(data, slope, downhill, bounds);
        if (!next) break;
        slope = *std::move(next);
    }
    return slope.theta;
}

double mean_cross_entropy(LogisticData const& data, std::span<double const> theta) {
    SumOfLogs logs;
    double linear = 0;
    for (std::size_t r = 0; r < data.targets.size(); ++r) {
        double const z = dot(data.inputs.data() + r * data.width, theta);
        logs.add(unit_at(z).tail);
        linear += std::max(z, 0.0) - data.targets[r] * z;
    }
    return (linear + logs.total()) / static_cast<double>(data.targets.size());
}

double mean_absolute_error(LogisticData const& data, std::span<double const> theta) {
    double sum = 0;
    for (std::size_t r = 0; r < data.targets.size(); ++r)
        sum += std::abs(unit_at(dot(data.inputs.data() + r * data.width, theta)).y - data.targets[r]);
    return sum / static_cast<double>(data.targets.size());
}

}   // namespace lore
