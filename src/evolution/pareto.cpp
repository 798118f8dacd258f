#include <lore/evolution/pareto.h>

#include <lore/core/names.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace lore {

namespace {

constexpr auto fronts_rule_names = names_for<FrontsRule>("dominance", "sweep");

}   // namespace

std::string_view name(FrontsRule rule) { return fronts_rule_names[rule]; }

FrontsRule fronts_rule(std::string_view wanted) { return fronts_rule_names.choice(wanted, "a rule for fronts"); }

bool dominates(Objectives const& a, Objectives const& b) {
    assert(a.count == b.count);
    bool better = false;
    for (int k = 0; k < a.count; ++k) {
        if (a.value[k] < b.value[k]) return false;
        better |= a.value[k] > b.value[k];
    }
    return better;
}

std::vector<std::vector<int>> non_dominated_fronts_plainly(std::span<Objectives const> points) {
    std::vector<int> left(points.size());
    std::iota(left.begin(), left.end(), 0);
    std::vector<std::vector<int>> fronts;
    while (!left.empty()) {
        std::vector<int> front, dominated;
        for (int const i : left) {
            bool const is_dominated =
                std::any_of(left.begin(), left.end(), [&](int j) { return dominates(points[j], points[i]); });
            (is_dominated ? dominated : front).push_back(i);
        }
        fronts.push_back(std::move(front));
        left = std::move(dominated);
    }
    return fronts;
}

std::vector<std::vector<int>> non_dominated_fronts(std::span<Objectives const> points) {
    // Efficient non-dominated sort with binary search (ENS-BS, Zhang et al. 2015): in lexicographic order, best first,
    // no point is dominated by a later one, and a point that is dominated by a member of front f is dominated by a
    // member of every earlier front. So bisection over the fronts of the points already placed finds the front of each.
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        if (points[a].value != points[b].value) return points[a].value > points[b].value;
        return a < b;
    });
    std::vector<std::vector<int>> fronts;
    std::size_t front = 0;
    for (std::size_t place = 0; place < order.size(); ++place) {
        int const i = order[place];
        // Many points are equal. They follow each other and share a front.
        if (place == 0 || !(points[order[place - 1]] == points[i])) {
            auto const dominated_in = [&](std::vector<int> const& members) {
                return std::any_of(members.rbegin(), members.rend(),
                                   [&](int j) { return dominates(points[j], points[i]); });
            };
            front = static_cast<std::size_t>(std::partition_point(fronts.begin(), fronts.end(), dominated_in) -
                                             fronts.begin());
            if (front == fronts.size()) fronts.emplace_back();
        }
        fronts[front].push_back(i);
    }
    for (std::vector<int>& members : fronts) std::sort(members.begin(), members.end());
    return fronts;
}

std::vector<std::vector<int>> fronts_by_sweep(std::span<Objectives const> points,
                                              std::span<std::uint64_t const> tie_key) {
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        if (points[a].value != points[b].value) return points[a].value > points[b].value;
        if (tie_key[a] != tie_key[b]) return tie_key[a] < tie_key[b];
        return a < b;
    });
    auto const second = [&](int i) { return points[i].value[1]; };
    std::vector<std::vector<int>> fronts;
    for (int const i : order) {
        assert(points[i].count == 2);
        if (fronts.empty() || second(i) <= second(fronts.back().back())) {
            fronts.push_back({i});
            continue;
        }
        // The latest points of the fronts never rise in their second objective.
        std::partition_point(fronts.begin(), fronts.end(), [&](std::vector<int> const& members) {
            return second(members.back()) > second(i);
        })->push_back(i);
    }
    for (std::vector<int>& members : fronts) std::sort(members.begin(), members.end());
    return fronts;
}

bool stands_before(std::span<Objectives const> points, int a, int b, int last) {
    for (int k = last; k >= 0; --k)
        if (points[a].value[k] != points[b].value[k]) return points[a].value[k] > points[b].value[k];
    return a < b;
}

std::vector<double> crowding_distances(std::span<Objectives const> points, std::span<int const> front,
                                       std::span<std::uint64_t const> tie_key, CrowdingRules const& rules) {
    std::vector<double> crowding(front.size(), 0.0);
    if (front.empty()) return crowding;
    std::vector<std::size_t> order(front.size());
    for (int k = 0; k < points[front[0]].count; ++k) {
        auto const value = [&](std::size_t place) { return points[front[place]].value[k]; };
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            if (rules.insertion) return stands_before(points, front[a], front[b], k);
            if (value(a) != value(b)) return value(a) < value(b);
            if (tie_key[front[a]] != tie_key[front[b]]) return tie_key[front[a]] < tie_key[front[b]];
            return a < b;
        });
        double const range = std::abs(value(order.back()) - value(order.front()));
        if (range == 0 && !rules.ends_among_equals) continue;
        crowding[order.front()] = crowding[order.back()] = std::numeric_limits<double>::infinity();
        if (range == 0) continue;
        for (std::size_t place = 1; place + 1 < order.size(); ++place)
            crowding[order[place]] += std::abs(value(order[place + 1]) - value(order[place - 1])) / range;
    }
    return crowding;
}

}   // namespace lore
