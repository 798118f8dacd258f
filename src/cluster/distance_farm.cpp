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
    default: return std::numeric_limits<int>::max();   // a pair takes a few nanoseconds
    }
}

Error unfit(std::string const& why) {
    return {"a message between ranks is damaged", why, "Check that all ranks run the same build."};
}

/// Each rank hands a pool on to two others, so that none sends it to all.
void hand_on(Post& post, int rank, int ranks, int number, Bytes const& pool) {
    for (int const to : {2 * rank + 1, 2 * rank + 2})
        if (to < ranks) post.send(to, MessageKind::pool, number, pool);
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

void measure_everywhere(FarmState& state, int number, DistanceKind kind, std::span<Descriptors const* const> pool,
                        int known, DistanceMatrix& matrix) {
    std::vector<int> const bounds = equal_areas(known, static_cast<int>(pool.size()), state.ranks());
    int const ranks = static_cast<int>(bounds.size()) - 1;   // that take part, rank 0 with the first range
    Stopwatch watch;
    hand_on(state.post, 0, ranks, number, pack_pool(kind, ranks, pool));
    for (int worker = 1; worker < ranks; ++worker)
        state.post.send(worker, MessageKind::rows, number, pack_rows({number, bounds[worker], bounds[worker + 1]}));
    state.post.flush();   // a long message moves only while both ends attend to it
    measure_rows(kind, pool, bounds[0], bounds[1], matrix);
    state.times.distances += watch.lap();
    MessageKind const kinds[]{MessageKind::distances, MessageKind::failure};
    for (int left = ranks - 1; left > 0; --left) {
        Message const message = state.post.await(kinds);
        state.times.waiting += watch.lap();
        if (message.kind == MessageKind::failure)
            throw Error(fmt::format("measuring distances failed on rank {}", message.sender), text_of(message),
                        "Resume the run.");
        if (message.unit != number || message.sender >= ranks)
            throw unfit("it answers for rows that no rank was given");
        unpack_distances(message.payload, bounds[message.sender], bounds[message.sender + 1], matrix);
        state.times.distances += watch.lap();
    }
}

}   // namespace

void DistanceFarm::measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                           DistanceMatrix& matrix) {
    int const size = static_cast<int>(pool.size());
    bool const share = state_.ranks() > 1 && size - known >= least_rows_to_share(kind);
    try {
        if (share) return measure_everywhere(state_, ++pools_, kind, pool, known, matrix);
    } catch (...) {
        state_.give_up();
        throw;
    }
    Stopwatch watch;
    measure_rows(kind, pool, known, size, matrix);
    state_.times.distances += watch.lap();
}

void DistanceWorker::take_pool(Message const& message) {
    unpack_pool(message.payload, pool_);
    number_ = message.unit;
    if (pool_.ranks > ranks_) throw unfit("it names ranks that there are not");
    hand_on(post_, rank_, pool_.ranks, number_, message.payload);
    post_.flush();   // or those behind it wait until this rank has measured
}

void DistanceWorker::measure(Message const& message) {
    RowRequest const request = unpack_rows(message.payload);
    MessageKind const kinds[]{MessageKind::pool};
    while (number_ < request.pool) take_pool(post_.await(kinds));
    if (number_ != request.pool || request.last > static_cast<int>(pool_.members.size()))
        throw unfit("it asks for rows that its pool does not have");
    std::vector<Descriptors const*> members;
    for (Descriptors const& member : pool_.members) members.push_back(&member);
    int const size = static_cast<int>(members.size());
    if (matrix_.size() < size) {
        matrix_ = {};   // so that there are never two
        matrix_ = DistanceMatrix{size};
    }
    measure_rows(pool_.kind, members, request.first, request.last, matrix_);
    post_.send(0, MessageKind::distances, message.unit, pack_distances(request.first, request.last, matrix_));
}

}   // namespace lore
