#include "distance_farm.h"

#include <lore/core/error.h>
#include <lore/core/stopwatch.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace lore {

namespace {

/// Below, sending costs more than measuring.
int least_rows_to_share(DistanceKind kind) {
    switch (kind) {
    case DistanceKind::trajectory: return 32;
    case DistanceKind::hamming: return 256;
    default: return std::numeric_limits<int>::max();   // another takes no longer than to send it
    }
}

/// Each rank hands a pool on to two others, so that none sends it to all. Waits until it has gone: a long message moves
/// only while both ends attend to it, and those behind would wait until this rank has measured.
void hand_on(Post& post, int rank, int ranks, Bytes const& pool) {
    for (int const to : {2 * rank + 1, 2 * rank + 2})
        if (to < ranks) post.send(to, MessageKind::pool, 0, pool);
    post.flush();
}

/// Boundaries of at most `parts` row ranges with about equally many pairs (i, j), j < i. None is empty.
std::vector<int> equal_areas(int first, int last, int parts) {
    std::vector<int> bounds{first};
    auto const pairs_below = [](int row) { return static_cast<double>(row) * (row - 1) / 2; };
    double const begin = pairs_below(first), area = pairs_below(last) - begin;
    for (int row = first, part = 1; row < last && part < parts; ++row)
        if (pairs_below(row) - begin >= area * part / parts && row > bounds.back()) {
            bounds.push_back(row);
            ++part;
        }
    bounds.push_back(last);
    return bounds;
}

/// The rows of each rank, from which every rank knows its own and how many take part: no more than have a range.
class Shares {
public:
    Shares(int known, int size, int ranks) : bounds_(equal_areas(known, size, ranks)) {}
    int ranks() const { return static_cast<int>(bounds_.size()) - 1; }
    int first(int rank) const { return bounds_[static_cast<std::size_t>(rank)]; }
    int last(int rank) const { return bounds_[static_cast<std::size_t>(rank) + 1]; }

private:
    std::vector<int> bounds_;
};

void measure_everywhere(FarmState& state, DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                        DistanceMatrix& matrix) {
    Stopwatch watch;
    Shares const shares{known, static_cast<int>(pool.size()), state.ranks()};
    hand_on(state.post, 0, shares.ranks(), pack_pool(kind, known, pool));
    measure_rows(kind, pool, shares.first(0), shares.last(0), matrix);
    state.times.distances += watch.lap();
    MessageKind const kinds[]{MessageKind::distances, MessageKind::failure};
    for (int left = shares.ranks() - 1; left > 0; --left) {
        Message const message = state.post.await(kinds);
        state.times.waiting += watch.lap();
        if (message.kind == MessageKind::failure)
            throw Error(fmt::format("measuring distances failed on rank {}", message.sender), text_of(message),
                        "Resume the run.");
        if (message.sender >= shares.ranks()) throw damaged_message("it answers for rows that no rank was given");
        unpack_distances(message.payload, shares.first(message.sender), shares.last(message.sender), matrix);
        state.times.distances += watch.lap();
    }
}

}   // namespace

void DistanceFarm::measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                           DistanceMatrix& matrix) {
    int const size = static_cast<int>(pool.size());
    bool const share = state_.ranks() > 1 && size - known >= least_rows_to_share(kind);
    try {
        if (share) return measure_everywhere(state_, kind, pool, known, matrix);
    } catch (...) {
        state_.give_up();
        throw;
    }
    Stopwatch watch;
    measure_rows(kind, pool, known, size, matrix);
    state_.times.distances += watch.lap();
}

std::vector<double> DistanceFarm::means(DistanceKind kind, std::span<Descriptors const* const> pool) {
    Stopwatch watch;
    std::vector<double> means = mean_distances(kind, pool);
    state_.times.distances += watch.lap();
    return means;
}

void DistanceWorker::measure(Message const& message) {
    unpack_pool(message.payload, pool_);
    int const size = static_cast<int>(pool_.members.size());
    Shares const shares{pool_.known, size, ranks_};
    if (rank_ >= shares.ranks()) throw damaged_message("its pool has no rows for this rank");
    hand_on(post_, rank_, shares.ranks(), message.payload);
    std::vector<Descriptors const*> members;
    for (Descriptors const& member : pool_.members) members.push_back(&member);
    if (matrix_.size() < size) {
        matrix_ = {};   // so that there are never two
        matrix_ = DistanceMatrix{size};
    }
    int const first = shares.first(rank_), last = shares.last(rank_);
    measure_rows(pool_.kind, members, first, last, matrix_);
    post_.send(0, MessageKind::distances, 0, pack_distances(first, last, matrix_));
}

}   // namespace lore
