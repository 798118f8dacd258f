#include <lore/behavior/distances.h>

#include <lore/core/names.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <vector>

namespace lore {

namespace {

constexpr int insertion_cost = tiles_per_side;   // in twelfths of the paper's unit
constexpr int deletion_cost = tiles_per_side;
int substitution_cost(Tile a, Tile b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

}   // namespace

double adhoc_distance(Descriptors const& a, Descriptors const& b) {
    assert(a.outcome.size() == b.outcome.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.outcome.size(); ++i) {
        double const difference = static_cast<double>(a.outcome[i]) - static_cast<double>(b.outcome[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

double hamming_distance(Descriptors const& a, Descriptors const& b) {
    assert(a.channels() == b.channels());
    std::size_t const bits_per_step = static_cast<std::size_t>(a.channels());
    std::size_t const shorter = static_cast<std::size_t>(std::min(a.steps(), b.steps()));
    std::size_t const longer = static_cast<std::size_t>(std::max(a.steps(), b.steps()));
    if (longer == 0) return 0;
    std::size_t differing = (longer - shorter) * bits_per_step;
    for (std::size_t word = 0; word < shorter * static_cast<std::size_t>(a.words()); ++word)
        differing +=
            static_cast<std::size_t>(std::popcount(static_cast<unsigned>(a.channel_bits[word] ^ b.channel_bits[word])));
    return static_cast<double>(differing) / static_cast<double>(longer * bits_per_step);
}

double trajectory_distance(Descriptors const& a, Descriptors const& b) {
    // cost[i][j]: of turning the first i tiles of a into the first j of b.
    std::size_t const rows = a.path.size() + 1, columns = b.path.size() + 1;
    std::vector<int> cells(rows * columns);
    auto const cost = [&](std::size_t i, std::size_t j) -> int& { return cells[i * columns + j]; };
    for (std::size_t i = 1; i < rows; ++i) cost(i, 0) = cost(i - 1, 0) + deletion_cost;
    for (std::size_t j = 1; j < columns; ++j) cost(0, j) = cost(0, j - 1) + insertion_cost;
    for (std::size_t i = 1; i < rows; ++i) {
        for (std::size_t j = 1; j < columns; ++j) {
            Tile const here_a = a.path[i - 1], here_b = b.path[j - 1];
            int const substitution = substitution_cost(here_a, here_b);
            int least = std::min(
                {cost(i - 1, j) + deletion_cost, cost(i, j - 1) + insertion_cost, cost(i - 1, j - 1) + substitution});
            if (i > 1 && j > 1 && here_a == b.path[j - 2] && a.path[i - 2] == here_b)
                least = std::min(least, cost(i - 2, j - 2) + substitution);
            cost(i, j) = least;
        }
    }
    return cost(rows - 1, columns - 1) / static_cast<double>(tiles_per_side);
}

double entropy_distance(Descriptors const& a, Descriptors const& b) {
    assert(a.channels() == b.channels());
    double sum = 0;
    for (std::size_t c = 0; c < a.entropies.size(); ++c) {
        double const difference = a.entropies[c] - b.entropies[c];
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

namespace {

struct Definition {
    DistanceKind kind;
    std::string_view name;
    double (*distance)(Descriptors const&, Descriptors const&);
};

/// All distances, in the order of DistanceKind.
constexpr auto definitions = std::to_array<Definition>({
    {DistanceKind::adhoc, "adhoc", adhoc_distance},
    {DistanceKind::hamming, "hamming", hamming_distance},
    {DistanceKind::trajectory, "trajectory", trajectory_distance},
    {DistanceKind::entropy, "entropy", entropy_distance},
});

consteval bool are_in_order() {
    for (std::size_t k = 0; k < definitions.size(); ++k)
        if (definitions[k].kind != static_cast<DistanceKind>(k)) return false;
    return definitions.size() == distance_kinds;
}
static_assert(are_in_order(), "definitions has every DistanceKind once, in order, and distance_kinds counts them");

Definition const& definition_of(DistanceKind kind) {
    assert(static_cast<int>(kind) < distance_kinds);
    return definitions[static_cast<std::size_t>(kind)];
}

constexpr auto kind_names = [] {
    Names<DistanceKind, definitions.size()> names;
    for (std::size_t k = 0; k < definitions.size(); ++k) names.words[k] = definitions[k].name;
    return names;
}();

}   // namespace

std::string_view name(DistanceKind kind) { return kind_names[kind]; }

std::string distance_names() { return kind_names.list(); }

DistanceKind distance_kind(std::string_view wanted) { return kind_names.choice(wanted, "a behavioral distance"); }

double distance(DistanceKind kind, Descriptors const& a, Descriptors const& b) {
    return definition_of(kind).distance(a, b);
}

}   // namespace lore
