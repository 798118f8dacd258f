#include <lore/cluster/farm.h>

#include "batch_worker.h"
#include "post.h"

#include <lore/archive/messages.h>
#include <lore/core/isa.h>
#include <lore/core/stopwatch.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <utility>

namespace lore {

namespace {

constexpr int units_held = 2;              ///< by a worker: the one it works on and the next
constexpr int row_units_a_rank = 4;        ///< more would even out better, but each carries all the paths
constexpr int least_rows_to_share = 32;    ///< below, sending costs more than measuring

/// Indices of a request, the largest networks first, so that lanes run networks of one size and the last units to be
/// handed out are the short ones.
std::vector<int> by_size(std::span<Genome const* const> genomes) {
    std::vector<int> order(genomes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        auto const size = [&](int i) {
            Genome const& genome = *genomes[static_cast<std::size_t>(i)];
            return std::pair{genome.biases.size(), genome.edges.size()};
        };
        return size(a) > size(b);
    });
    return order;
}

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

Bytes bytes_of(std::string_view text) {
    auto const* const first = reinterpret_cast<std::byte const*>(text.data());
    return {first, first + text.size()};
}

template <class T>
Bytes bytes_of_struct(T const& value) {
    auto const* const first = reinterpret_cast<std::byte const*>(&value);
    return {first, first + sizeof value};
}

} // namespace

EvaluationFailure::EvaluationFailure(int index, int rank, Genome genome, std::string reason)
    : Error(fmt::format("an evaluation failed on rank {}", rank), reason, "Repeat it with lore-replay."), index_(index), rank_(rank),
      genome_(std::move(genome)), reason_(std::move(reason)) {}

struct Farm::State {
    Communicator communicator;
    BatchEvaluation evaluate;
    Post post;
    RankTimes times;
    bool working = true;   ///< workers are waiting in serve()
    bool broken = false;

    /// Replies that nobody will take may be under way.
    void give_up() {
        working = false;
        broken = communicator.size() > 1;
    }
    State(Communicator group, BatchEvaluation evaluation)
        : communicator(std::move(group)), evaluate(with_test_hooks(std::move(evaluation), communicator.rank())),
          post(communicator.handle().comm) {}
};

/// Work cut into units that any rank can do.
struct Farm::Job {
    int units;
    MessageKind request_kind, reply_kind;
    std::function<Bytes(int unit)> request;
    std::function<void(int unit)> work_here;
    std::function<void(int unit, std::span<std::byte const> reply)> accept;
    /// What a worker's complaint about a unit means.
    std::function<void(Message const&)> fail;
};

Farm::Farm(Communicator communicator, BatchEvaluation evaluate)
    : state_(std::make_unique<State>(std::move(communicator), std::move(evaluate))) {}

Farm::~Farm() {
    if (state_->working) stop();
}

void Farm::distribute(Job const& job) {
    State& state = *state_;
    std::vector<int> held(static_cast<std::size_t>(state.communicator.size()), 0);
    int next = 0, done = 0;
    MessageKind const replies[]{job.reply_kind, MessageKind::failure};
    auto const hand_out = [&] {
        // First everybody gets one; second ones only while rank 0 has one for itself.
        for (int most = 1; most <= units_held; ++most)
            for (int worker = 1; worker < state.communicator.size(); ++worker) {
                if (job.units - next <= (most > 1 ? 1 : 0)) return;
                if (held[static_cast<std::size_t>(worker)] >= most) continue;
                state.post.send(worker, job.request_kind, next, job.request(next));
                ++held[static_cast<std::size_t>(worker)];
                ++next;
            }
    };
    auto const take = [&](Message const& message) {
        if (message.kind == MessageKind::failure) {
            state.give_up();
            job.fail(message);
        }
        job.accept(message.unit, message.payload);
        --held[static_cast<std::size_t>(message.sender)];
        ++done;
    };
    while (done < job.units) {
        while (auto message = state.post.receive(replies)) take(*message);
        hand_out();
        if (next < job.units) {
            job.work_here(next++);
            ++done;
        } else if (done < job.units) {
            Stopwatch watch;
            Message const message = state.post.await(replies);
            state.times.waiting += watch.lap();
            take(message);
        }
    }
}

std::vector<Evaluation> Farm::evaluate(std::span<Genome const* const> genomes) {
    State& state = *state_;
    std::vector<int> const order = by_size(genomes);
    std::vector<Genome const*> sorted;
    for (int const index : order) sorted.push_back(genomes[static_cast<std::size_t>(index)]);

    int const count = static_cast<int>(genomes.size()), ranks = state.communicator.size();
    int const unit_size = ranks == 1 ? std::max(1, count) : std::clamp((count + ranks - 1) / ranks, 1, lanes_of(active_isa()));
    auto const unit_of = [&](int unit) {
        int const first = unit * unit_size;
        return std::span<Genome const* const>{sorted}.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(std::min(unit_size, count - first)));
    };
    std::vector<Evaluation> results(genomes.size());
    auto const store = [&](int unit, std::vector<Evaluation> evaluations) {
        assert(evaluations.size() == unit_of(unit).size());
        for (std::size_t k = 0; k < evaluations.size(); ++k)
            results[static_cast<std::size_t>(order[static_cast<std::size_t>(unit * unit_size) + k])] = std::move(evaluations[k]);
    };
    auto const fail = [&](int unit, std::size_t place, int rank, std::string reason) {
        state.give_up();
        int const index = order[static_cast<std::size_t>(unit * unit_size) + place];
        throw EvaluationFailure(index, rank, *genomes[static_cast<std::size_t>(index)], std::move(reason));
    };

    Job job;
    job.units = (count + unit_size - 1) / unit_size;
    job.request_kind = MessageKind::evaluate;
    job.reply_kind = MessageKind::evaluated;
    job.request = [&](int unit) { return pack_genomes(unit_of(unit)); };
    job.work_here = [&](int unit) {
        Stopwatch watch;
        BatchOutcome outcome = evaluate_guarded(state.evaluate, unit_of(unit));
        state.times.evaluation += watch.lap();
        if (outcome.culprit) fail(unit, outcome.culprit->place, state.communicator.rank(), outcome.culprit->reason);
        store(unit, std::move(outcome.evaluations));
    };
    job.accept = [&](int unit, std::span<std::byte const> reply) { store(unit, unpack_evaluations(reply)); };
    job.fail = [&](Message const& message) {
        std::uint64_t place = 0;
        std::memcpy(&place, message.payload.data(), sizeof place);
        auto const* const text = reinterpret_cast<char const*>(message.payload.data());
        fail(message.unit, static_cast<std::size_t>(place), message.sender, std::string{text + sizeof place, message.payload.size() - sizeof place});
    };
    distribute(job);
    return results;
}

void Farm::measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known, DistanceMatrix& matrix) {
    State& state = *state_;
    int const size = static_cast<int>(pool.size());
    if (state.communicator.size() == 1 || kind != DistanceKind::trajectory || size - known < least_rows_to_share) {
        Stopwatch watch;
        Evaluator::measure(kind, pool, known, matrix);
        state.times.distances += watch.lap();
        return;
    }
    std::vector<int> const bounds = equal_areas(known, size, row_units_a_rank * state.communicator.size());
    auto const first = [&](int unit) { return bounds[static_cast<std::size_t>(unit)]; };
    auto const last = [&](int unit) { return bounds[static_cast<std::size_t>(unit) + 1]; };
    Job job;
    job.units = static_cast<int>(bounds.size()) - 1;
    job.request_kind = MessageKind::rows;
    job.reply_kind = MessageKind::distances;
    job.request = [&](int unit) { return pack_rows(first(unit), last(unit), pool); };
    job.work_here = [&](int unit) {
        Stopwatch watch;
        measure_rows(kind, pool, first(unit), last(unit), matrix);
        state.times.distances += watch.lap();
    };
    job.accept = [&](int unit, std::span<std::byte const> reply) { unpack_distances(reply, first(unit), last(unit), matrix); };
    job.fail = [&](Message const& message) {
        throw Error(fmt::format("measuring distances failed on rank {}", message.sender),
                    std::string{reinterpret_cast<char const*>(message.payload.data()), message.payload.size()}, "Resume the run.");
    };
    distribute(job);
}

bool Farm::broken() const { return state_->broken; }

std::vector<RankTimes> Farm::stop() {
    State& state = *state_;
    std::vector<RankTimes> times{state.times};
    if (!std::exchange(state.working, false)) return times;
    for (int worker = 1; worker < state.communicator.size(); ++worker) state.post.send(worker, MessageKind::stop, 0, {});
    times.resize(static_cast<std::size_t>(state.communicator.size()));
    MessageKind const kinds[]{MessageKind::times};
    for (int worker = 1; worker < state.communicator.size(); ++worker) {
        Message const message = state.post.await(kinds);
        std::memcpy(&times[static_cast<std::size_t>(message.sender)], message.payload.data(), sizeof(RankTimes));
    }
    state.post.flush();
    return times;
}

void serve(Communicator const& communicator, BatchEvaluation const& evaluation) {
    BatchEvaluation const evaluate = with_test_hooks(evaluation, communicator.rank());
    Post post{communicator.handle().comm};
    RankTimes times;
    DistanceMatrix matrix;
    MessageKind const kinds[]{MessageKind::evaluate, MessageKind::rows, MessageKind::stop};
    while (true) {
        Stopwatch watch;
        Message const message = post.await(kinds);
        times.waiting += watch.lap();
        if (message.kind == MessageKind::stop) break;
        try {
            if (message.kind == MessageKind::evaluate) {
                std::vector<Genome> const genomes = unpack_genomes(message.payload);
                std::vector<Genome const*> pointers;
                for (Genome const& genome : genomes) pointers.push_back(&genome);
                BatchOutcome const outcome = evaluate_guarded(evaluate, pointers);
                if (outcome.culprit) {
                    Bytes complaint = bytes_of_struct(std::uint64_t{outcome.culprit->place});
                    Bytes const reason = bytes_of(outcome.culprit->reason);
                    complaint.insert(complaint.end(), reason.begin(), reason.end());
                    post.send(0, MessageKind::failure, message.unit, complaint);
                } else {
                    post.send(0, MessageKind::evaluated, message.unit, pack_evaluations(outcome.evaluations));
                }
                times.evaluation += watch.lap();
            } else {
                RowRequest const request = unpack_rows(message.payload);
                std::vector<Descriptors const*> pool;
                for (Descriptors const& member : request.pool) pool.push_back(&member);
                if (matrix.size() < request.last) matrix = DistanceMatrix{request.last};
                measure_rows(DistanceKind::trajectory, pool, request.first, request.last, matrix);
                post.send(0, MessageKind::distances, message.unit, pack_distances(request.first, request.last, matrix));
                times.distances += watch.lap();
            }
        } catch (std::exception const& error) {
            if (message.kind == MessageKind::evaluate) throw;   // not an evaluation's: main ends the job
            post.send(0, MessageKind::failure, message.unit, bytes_of(error.what()));
        }
    }
    post.send(0, MessageKind::times, 0, bytes_of_struct(times));
    post.flush();
}

} // namespace lore
