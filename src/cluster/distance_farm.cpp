#include "distance_farm.h"

#include <lore/core/error.h>
#include <lore/core/stopwatch.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>

namespace lore {

namespace {

/// Below, sending costs more than measuring.
int least_rows_to_share(DistanceKind kind) {
    switch (kind) {
    case DistanceKind::trajectory: return 32;
    case DistanceKind::hamming: return 256;
    default: return std::numeric_limits<int>::max();   // nobody needs so many
    }
}
constexpr int least_means_to_share = 1000;

/// Each rank hands a pool on to two others, so that none sends it to all; also a rank that has nothing to measure, so
/// that none must read it first. Waits until it has gone: a long message moves only while both ends attend to it, and
/// those behind would wait until this rank has measured.
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

/// Boundaries of at most `parts` ranges of about equal length. None is empty.
std::vector<int> equal_lengths(int size, int parts) {
    parts = std::min(parts, size);
    std::vector<int> bounds;
    for (int part = 0; part <= parts; ++part) bounds.push_back(static_cast<int>(std::int64_t{size} * part / parts));
    return bounds;
}

/// The members of each rank, from which every rank knows its own and how many take part: no more than have a range.
/// By Euclidean kinds each rank finds the means of its members, by others their rows of the matrix.
class Shares {
public:
    Shares(DistanceKind kind, int known, int size, int ranks)
        : bounds_(is_euclidean(kind) ? equal_lengths(size, ranks) : equal_areas(known, size, ranks)) {}
    int ranks() const { return static_cast<int>(bounds_.size()) - 1; }
    int first(int rank) const { return bounds_[static_cast<std::size_t>(rank)]; }
    int last(int rank) const { return bounds_[static_cast<std::size_t>(rank) + 1]; }

private:
    std::vector<int> bounds_;
};

/// What is to be measured, and how rank 0 does its part.
struct Measurement {
    DistanceKind kind;
    std::span<Descriptors const* const> pool;
    int known;
    std::function<void(int first, int last)> measure;
    std::function<std::span<double>(int first, int last)> result;   ///< where the answer of that range belongs
};

void measure_everywhere(FarmState& state, Measurement const& wanted) {
    Stopwatch watch;
    Shares const shares{wanted.kind, wanted.known, static_cast<int>(wanted.pool.size()), state.ranks()};
    hand_on(state.post, 0, state.ranks(), pack_pool(wanted.kind, wanted.known, wanted.pool));
    wanted.measure(shares.first(0), shares.last(0));
    state.times.distances += watch.lap();
    MessageKind const kinds[]{MessageKind::distances, MessageKind::failure};
    for (int left = shares.ranks() - 1; left > 0; --left) {
        Message const message = state.post.await(kinds);
        state.times.waiting += watch.lap();
        if (message.kind == MessageKind::failure)
            throw Error(fmt::format("measuring distances failed on rank {}", message.sender), text_of(message),
                        "Resume the run.");
        if (message.sender >= shares.ranks()) throw damaged_message("it answers for rows that no rank was given");
        unpack_distances(message.payload, wanted.result(shares.first(message.sender), shares.last(message.sender)));
        state.times.distances += watch.lap();
    }
}

/// Everywhere if there are `least` to measure.
void measure_here_or_everywhere(FarmState& state, Measurement const& wanted, int least) {
    int const size = static_cast<int>(wanted.pool.size());
    if (state.ranks() > 1 && size - wanted.known >= least) {
        try {
            return measure_everywhere(state, wanted);
        } catch (...) {
            state.give_up();
            throw;
        }
    }
    Stopwatch watch;
    wanted.measure(wanted.known, size);
    state.times.distances += watch.lap();
}

}   // namespace

void DistanceFarm::measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                           DistanceMatrix& matrix) {
    auto const rows = [&](int first, int last) { return matrix.rows(first, last); };
    auto const measure = [&](int first, int last) { measure_rows(kind, pool, first, last, matrix); };
    measure_here_or_everywhere(state_, {kind, pool, known, measure, rows}, least_rows_to_share(kind));
}

std::vector<double> DistanceFarm::means(DistanceKind kind, std::span<Descriptors const* const> pool) {
    std::vector<double> means(pool.size());
    auto const part = [&](int first, int last) {
        return std::span{means}.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
    };
    auto const measure = [&](int first, int last) {
        std::ranges::copy(mean_distances(kind, pool, first, last), part(first, last).begin());
    };
    measure_here_or_everywhere(state_, {kind, pool, 0, measure, part}, least_means_to_share);
    return means;
}

void DistanceWorker::measure(Message const& message) {
    hand_on(post_, rank_, ranks_, message.payload);
    unpack_pool(message.payload, pool_);
    int const size = static_cast<int>(pool_.members.size());
    Shares const shares{pool_.kind, pool_.known, size, ranks_};
    if (rank_ >= shares.ranks()) return;
    std::vector<Descriptors const*> members;
    for (Descriptors const& member : pool_.members) members.push_back(&member);
    int const first = shares.first(rank_), last = shares.last(rank_);
    if (is_euclidean(pool_.kind)) {
        post_.send(0, MessageKind::distances, 0, pack_distances(mean_distances(pool_.kind, members, first, last)));
        return;
    }
    if (matrix_.size() < size) {
        matrix_ = {};   // so that there are never two
        matrix_ = DistanceMatrix{size};
    }
    measure_rows(pool_.kind, members, first, last, matrix_);
    post_.send(0, MessageKind::distances, 0, pack_distances(matrix_.rows(first, last)));
}

}   // namespace lore
