#include "shared_rows.h"

#include <lore/archive/messages.h>
#include <lore/core/stopwatch.h>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr int ranges_a_rank = 4;   ///< more would even out better, but each message carries the paths it needs
constexpr int ranges_held = 2;     ///< by a worker: the one it works on and the next

/// Boundaries of row ranges with about equally many pairs (i, j), j < i.
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

}   // namespace

void measure_together(Post& post, int ranks, std::span<Descriptors const* const> pool, int known,
                      DistanceMatrix& matrix, RankTimes& times) {
    std::vector<int> const bounds = equal_areas(known, static_cast<int>(pool.size()), ranges_a_rank * ranks);
    int const ranges = static_cast<int>(bounds.size()) - 1;
    auto const first = [&](int range) { return bounds[static_cast<std::size_t>(range)]; };
    auto const last = [&](int range) { return bounds[static_cast<std::size_t>(range) + 1]; };
    std::vector<int> held(static_cast<std::size_t>(ranks), 0);
    int next = 0, done = 0;

    auto const hand_out = [&] {
        // First everybody gets one; second ones only while rank 0 has one for itself.
        for (int most = 1; most <= ranges_held; ++most)
            for (int worker = 1; worker < ranks; ++worker) {
                if (ranges - next <= (most > 1 ? 1 : 0)) return;
                int& his = held[static_cast<std::size_t>(worker)];
                if (his >= most) continue;
                post.send(worker, MessageKind::rows, next, pack_rows(first(next), last(next), pool));
                ++his;
                ++next;
            }
    };
    auto const take = [&](Message const& message) {
        if (message.kind == MessageKind::failure)
            throw Error(fmt::format("measuring distances failed on rank {}", message.sender),
                        std::string{reinterpret_cast<char const*>(message.payload.data()), message.payload.size()},
                        "Resume the run.");
        unpack_distances(message.payload, first(message.unit), last(message.unit), matrix);
        --held[static_cast<std::size_t>(message.sender)];
        ++done;
    };
    MessageKind const kinds[]{MessageKind::distances, MessageKind::failure};
    Stopwatch watch;
    while (done < ranges) {
        while (auto message = post.receive(kinds)) take(*message);
        hand_out();
        if (next < ranges) {
            measure_rows(DistanceKind::trajectory, pool, first(next), last(next), matrix);
            ++next;
            ++done;
        } else if (done < ranges) {
            times.distances += watch.lap();
            Message const message = post.await(kinds);
            times.waiting += watch.lap();
            take(message);
        }
    }
    times.distances += watch.lap();
}

void measure_for_rank_0(Post& post, Message const& message, DistanceMatrix& scratch) {
    RowRequest const request = unpack_rows(message.payload);
    std::vector<Descriptors const*> pool;
    for (Descriptors const& member : request.pool) pool.push_back(&member);
    if (scratch.size() < request.last) scratch = DistanceMatrix{request.last};
    measure_rows(DistanceKind::trajectory, pool, request.first, request.last, scratch);
    post.send(0, MessageKind::distances, message.unit, pack_distances(request.first, request.last, scratch));
}

}   // namespace lore
