#include "pool_distances.h"

#include <lore/behavior/mean_distances.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace lore {

namespace {

/// Children are measured together: fewer would cost more each (Hamming looks for what many share), more would leave
/// more to the end. While this rank is idle, few are enough.
constexpr int enough = 96, enough_when_idle = 16;
/// Of a larger pool all distances are left to the end, where the ranks share those that take long: one rank would have
/// too much to do, and a matrix in another order costs time.
constexpr int largest_pool_measured_early = 1000;

}   // namespace

PoolDistances::PoolDistances(Population const& parents, int children, DistanceKind kind, DistanceMatrix spare)
    : kind_(kind), parents_(static_cast<int>(parents.members.size())),
      measured_(parents.distance_kind == kind ? parents.distances.size() : 0) {
    if (is_euclidean(kind_)) return;
    DistanceMatrix const none;
    DistanceMatrix const& known = measured_ > 0 ? parents.distances : none;
    matrix_ = known.extended(parents_ + children - known.size(), std::move(spare));
    order_.resize(static_cast<std::size_t>(parents_));
    std::iota(order_.begin(), order_.end(), 0);
    for (Individual const& parent : parents.members) shown_.push_back(parent.descriptors.get());
}

void PoolDistances::completed(int child, Evaluation const& evaluation) {
    if (!early()) return;
    order_.push_back(parents_ + child);
    shown_.push_back(&evaluation.descriptors);
    measure_if_waiting(enough);
}

void PoolDistances::idle() {
    if (early()) measure_if_waiting(enough_when_idle);
}

bool PoolDistances::early() const { return !is_euclidean(kind_) && matrix_.size() <= largest_pool_measured_early; }

void PoolDistances::measure_if_waiting(int least) {
    int const present = static_cast<int>(shown_.size());
    if (present - measured_ < least) return;
    measure_rows(kind_, shown_, measured_, present, matrix_);
    measured_ = present;
}

PoolDistances::Measured PoolDistances::finish(Population const& pool, DistanceMeasurer& measurer) && {
    std::vector<Descriptors const*> members;
    for (Individual const& member : pool.members) members.push_back(member.descriptors.get());
    if (is_euclidean(kind_)) return {measurer.means(kind_, members), {}};
    assert(static_cast<int>(members.size()) == matrix_.size());
    std::vector<int> place(members.size(), -1);   // of a member in order_
    for (std::size_t k = 0; k < order_.size(); ++k) place[static_cast<std::size_t>(order_[k])] = static_cast<int>(k);
    for (std::size_t member = 0; member < place.size(); ++member)
        if (place[member] < 0) {
            place[member] = static_cast<int>(order_.size());
            order_.push_back(static_cast<int>(member));
        }
    shown_.clear();
    for (int const member : order_) shown_.push_back(members[static_cast<std::size_t>(member)]);
    measurer.measure(kind_, shown_, measured_, matrix_);
    if (!std::is_sorted(order_.begin(), order_.end())) matrix_ = matrix_.select(place);
    return {matrix_.means(), std::move(matrix_)};
}

}   // namespace lore
