#include <lore/statistics/mann_whitney.h>

#include <lore/core/error.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <boost/math/distributions/normal.hpp>

namespace lore {

namespace {

void require_numbers(std::span<double const> sample, char const* which) {
    if (sample.empty())
        throw Error("cannot compare two samples", std::string{"the "} + which + " is empty",
                    "Give each at least one number.");
    if (std::any_of(sample.begin(), sample.end(), [](double x) { return std::isnan(x); }))
        throw Error("cannot compare two samples", std::string{"the "} + which + " holds a NaN",
                    "Find out where it comes from.");
}

/// What both forms of the test need: U of the first sample and how the values are tied.
struct Ranking {
    double u = 0;
    double tie_sum = 0;   ///< sum of t^3 - t over groups of t equal values
};

Ranking rank(std::span<double const> first, std::span<double const> second) {
    struct Value {
        double value;
        bool of_first;
    };
    std::vector<Value> pooled;
    for (double x : first) pooled.push_back({x, true});
    for (double x : second) pooled.push_back({x, false});
    std::sort(pooled.begin(), pooled.end(), [](Value const& a, Value const& b) { return a.value < b.value; });

    Ranking ranking;
    double smaller_in_second = 0;
    for (std::size_t begin = 0, end = 0; begin < pooled.size(); begin = end) {
        double ours = 0, theirs = 0;
        for (end = begin; end < pooled.size() && pooled[end].value == pooled[begin].value; ++end)
            (pooled[end].of_first ? ours : theirs) += 1;
        ranking.u += ours * (smaller_in_second + theirs / 2);
        smaller_in_second += theirs;
        double const group = ours + theirs;
        ranking.tie_sum += group * group * group - group;
    }
    return ranking;
}

/// P(U >= u) when all arrangements of n values of ours among m of theirs are equally likely.
///
/// By induction on the largest value of all (Mann and Whitney 1947): with chance j / (i + j) it is one of our j and
/// beats all their i, which leaves j - 1 and i; else it is theirs and leaves j and i - 1. Chances rather than counts,
/// so that only positive numbers below 1 are ever added and nothing overflows.
double exact_tail(double u, int n, int m) {
    int const most = n * m;
    // ways[j][k]: chance of U = k for j of ours and the i of theirs counted so far.
    std::vector<std::vector<double>> ways(static_cast<std::size_t>(n) + 1,
                                          std::vector<double>(static_cast<std::size_t>(most) + 1, 0.0));
    for (auto& row : ways) row[0] = 1;
    for (int i = 1; i <= m; ++i) {
        for (int j = 1; j <= n; ++j) {
            double const last_is_ours = static_cast<double>(j) / (i + j);
            auto& row = ways[static_cast<std::size_t>(j)];
            auto const& fewer = ways[static_cast<std::size_t>(j) - 1];
            for (int k = i * j; k >= 0; --k) {
                double const without = k <= (i - 1) * j ? row[static_cast<std::size_t>(k)] : 0.0;
                double const with = k >= i ? fewer[static_cast<std::size_t>(k - i)] : 0.0;
                row[static_cast<std::size_t>(k)] = (1 - last_is_ours) * without + last_is_ours * with;
            }
        }
    }
    double tail = 0;
    auto const& shares = ways.back();
    for (int k = most; k >= static_cast<int>(std::ceil(u)); --k) tail += shares[static_cast<std::size_t>(k)];
    return tail;
}

double normal_tail(double u, double n, double m, double tie_sum) {
    double const total = n + m;
    double const variance = n * m / 12 * (total + 1 - tie_sum / (total * (total - 1)));
    if (!(variance > 0)) return 1;   // all values equal: nothing speaks against equality
    double const z = (u - n * m / 2 - 0.5) / std::sqrt(variance);
    return boost::math::cdf(boost::math::complement(boost::math::normal_distribution<double>{}, z));
}

}   // namespace

MannWhitney mann_whitney(std::span<double const> first, std::span<double const> second) {
    require_numbers(first, "first");
    require_numbers(second, "second");
    Ranking const ranking = rank(first, second);
    double const n = static_cast<double>(first.size()), m = static_cast<double>(second.size());
    double const larger = std::max(ranking.u, n * m - ranking.u);

    MannWhitney result;
    result.u = ranking.u;
    result.exact = ranking.tie_sum == 0 && std::max(first.size(), second.size()) <= exact_sample_limit;
    double const tail = result.exact
                            ? exact_tail(larger, static_cast<int>(first.size()), static_cast<int>(second.size()))
                            : normal_tail(larger, n, m, ranking.tie_sum);
    result.p = std::min(1.0, 2 * tail);
    return result;
}

double vargha_delaney_a12(std::span<double const> first, std::span<double const> second) {
    require_numbers(first, "first");
    require_numbers(second, "second");
    return rank(first, second).u / (static_cast<double>(first.size()) * static_cast<double>(second.size()));
}

}   // namespace lore
