#include "distance_farm.h"

#include <lore/archive/messages.h>
#include <lore/core/error.h>
#include <lore/core/stopwatch.h>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr int least_rows_to_share = 32;   ///< below, sending costs more than measuring
constexpr int ranges_a_rank = 4;          ///< more would even out better, but each message carries the paths it needs
constexpr int ranges_held = 2;            ///< by a worker: the one it works on and the next

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

/// One measurement on its way through all ranks.
class SharedRows {
public:
    SharedRows(FarmState& state, std::span<Descriptors const* const> pool, int known, DistanceMatrix& matrix)
        : state_(state), pool_(pool), matrix_(matrix),
          bounds_(equal_areas(known, static_cast<int>(pool.size()), ranges_a_rank * state.ranks())),
          held_(static_cast<std::size_t>(state.ranks()), 0) {}

    void measure() {
        Stopwatch watch;
        while (done_ < ranges()) {
            while (auto message = state_.post.receive(kinds)) take(*message);
            hand_out();
            if (next_ < ranges()) {
                measure_rows(DistanceKind::trajectory, pool_, first(next_), last(next_), matrix_);
                ++next_;
                ++done_;
            } else if (done_ < ranges()) {
                state_.times.distances += watch.lap();
                Message const message = state_.post.await(kinds);
                state_.times.waiting += watch.lap();
                take(message);
            }
        }
        state_.times.distances += watch.lap();
    }

private:
    static constexpr MessageKind kinds[]{MessageKind::distances, MessageKind::failure};

    int ranges() const { return static_cast<int>(bounds_.size()) - 1; }
    int first(int range) const { return bounds_[static_cast<std::size_t>(range)]; }
    int last(int range) const { return bounds_[static_cast<std::size_t>(range) + 1]; }

    /// First every worker gets one range, then a second one as long as that leaves one to rank 0.
    void hand_out() {
        for (int most = 1; most <= ranges_held; ++most)
            for (int worker = 1; worker < state_.ranks(); ++worker) {
                if (ranges() - next_ <= (most > 1 ? 1 : 0)) return;
                int& held = held_[static_cast<std::size_t>(worker)];
                if (held >= most) continue;
                state_.post.send(worker, MessageKind::rows, next_, pack_rows(first(next_), last(next_), pool_));
                ++held;
                ++next_;
            }
    }

    void take(Message const& message) {
        if (message.kind == MessageKind::failure)
            throw Error(fmt::format("measuring distances failed on rank {}", message.sender), text_of(message),
                        "Resume the run.");
        unpack_distances(message.payload, first(message.unit), last(message.unit), matrix_);
        --held_[static_cast<std::size_t>(message.sender)];
        ++done_;
    }

    FarmState& state_;
    std::span<Descriptors const* const> pool_;
    DistanceMatrix& matrix_;
    std::vector<int> bounds_;   ///< of the ranges
    std::vector<int> held_;     ///< ranges by each worker, at work or waiting
    int next_ = 0, done_ = 0;   ///< ranges
};

}   // namespace

void DistanceFarm::measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known,
                           DistanceMatrix& matrix) {
    int const size = static_cast<int>(pool.size());
    bool const share = state_.ranks() > 1 && kind == DistanceKind::trajectory && size - known >= least_rows_to_share;
    try {
        if (share) return SharedRows{state_, pool, known, matrix}.measure();
    } catch (...) {
        state_.give_up();
        throw;
    }
    Stopwatch watch;
    measure_rows(kind, pool, known, size, matrix);
    state_.times.distances += watch.lap();
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
