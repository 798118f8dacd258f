#include <lore/cluster/farm.h>

#include "guarded_stream.h"
#include "post.h"
#include "share.h"
#include "shared_rows.h"

#include <lore/archive/messages.h>
#include <lore/core/stopwatch.h>
#include <lore/episode/lanes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

namespace lore {

namespace {

constexpr int most_in_a_message = 10;     ///< genomes; about 3 kB, which MPI sends without asking first
constexpr int least_rows_to_share = 32;   ///< below, sending costs more than measuring

}   // namespace

EvaluationFailure::EvaluationFailure(int index, int rank, Genome genome, std::string reason)
    : Error(fmt::format("an evaluation failed on rank {}", rank), reason, "Repeat it with lore-replay."), index_(index),
      rank_(rank), genome_(std::move(genome)), reason_(std::move(reason)) {}

struct Farm::State {
    Communicator communicator;
    StreamEvaluation evaluate;
    Post post;
    RankTimes times;
    bool working = true;   ///< the others are in serve()
    bool broken = false;

    State(Communicator group, StreamEvaluation evaluation)
        : communicator(std::move(group)), evaluate(with_test_hooks(std::move(evaluation), communicator.rank())),
          post(communicator.handle().comm) {}
    /// Replies that nobody will take may be under way.
    void give_up() {
        working = false;
        broken = communicator.size() > 1;
    }
};

/// A request on its way through all ranks: feeds the lanes of this one and, between their steps, the other ranks.
/// A ticket is a place in the order of size, the largest network first.
class Farm::OwnFeed : public EvaluationFeed {
public:
    OwnFeed(State& state, std::span<Genome const* const> genomes, Audience* audience)
        : results(genomes.size()), state_(state), genomes_(genomes), audience_(audience), order_(genomes.size()),
          ranks_(state.communicator.size()), lanes_(lane_count()), share_(share_of_a_worker(size(), ranks_, lanes_)),
          held_(static_cast<std::size_t>(ranks_), 0), taken_(held_) {
        std::iota(order_.begin(), order_.end(), 0);
        std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
            return larger(*genomes_[static_cast<std::size_t>(a)], *genomes_[static_cast<std::size_t>(b)]);
        });
        hand_out();
    }

    std::optional<Item> next() override {
        if (left() == 0) return std::nullopt;
        int const ticket = next_++;
        return Item{ticket, genome(ticket)};
    }
    void deliver(int ticket, Evaluation evaluation) override {
        Evaluation& result = results[static_cast<std::size_t>(index(ticket))];
        result = std::move(evaluation);
        ++done_;
        if (ranks_ == 1 || audience_ == nullptr || failure) return;
        Stopwatch watch;
        audience_->arrive(index(ticket), result);
        audience_seconds_ += watch.lap();
    }
    void pulse() override {
        if (++pulses_ % pulses_a_look != 0) return;
        while (auto message = state_.post.receive(kinds)) take(*message);
        hand_out();
    }

    void wait_for_others() {
        while (done_ < size() && !failure) {
            auto message = state_.post.receive(kinds);
            if (!message && audience_ != nullptr) {
                Stopwatch watch;
                audience_->lull();
                audience_seconds_ += watch.lap();
            }
            take(message ? *message : state_.post.await(kinds));
            hand_out();
        }
    }
    int index(int ticket) const { return order_[static_cast<std::size_t>(ticket)]; }
    /// Spent by the audience since the last call [s].
    double audience_lap() { return std::exchange(audience_seconds_, 0.0); }

    std::vector<Evaluation> results;
    /// Of another rank. Not thrown from here, where it would look like one of this rank's.
    std::optional<EvaluationFailure> failure;

private:
    static constexpr MessageKind kinds[]{MessageKind::evaluated, MessageKind::failure};

    int size() const { return static_cast<int>(genomes_.size()); }
    int left() const { return failure ? 0 : size() - next_; }
    Genome const* genome(int ticket) const { return genomes_[static_cast<std::size_t>(index(ticket))]; }

    /// Keeps the next set waiting at every worker until it has had its share; who is out of work then gets more.
    void hand_out() {
        for (int worker = 1; worker < ranks_; ++worker) {
            int& held = held_[static_cast<std::size_t>(worker)];
            int& taken = taken_[static_cast<std::size_t>(worker)];
            int const due = held == 0 && taken >= share_ ? lanes_ / 2 : std::min(share_ - taken, 2 * lanes_ - held);
            for (int batch_left = std::min(due, left()); batch_left > 0;) {
                std::vector<Genome const*> batch;
                for (int count = std::min(batch_left, most_in_a_message); count > 0; --count)
                    batch.push_back(genome(next_ + static_cast<int>(batch.size())));
                state_.post.send(worker, MessageKind::evaluate, next_, pack_genomes(batch));
                auto const sent = static_cast<int>(batch.size());
                held += sent;
                taken += sent;
                next_ += sent;
                batch_left -= sent;
            }
        }
    }

    void take(Message const& message) {
        if (message.kind == MessageKind::failure) {
            if (!failure)
                failure.emplace(
                    index(message.unit), message.sender, *genome(message.unit),
                    std::string{reinterpret_cast<char const*>(message.payload.data()), message.payload.size()});
            return;
        }
        for (auto& [ticket, evaluation] : unpack_deliveries(message.payload)) {
            if (ticket >= next_)
                throw Error("a message between ranks is damaged", "nobody was given what it says is done",
                            "Check that all ranks run the same build.");
            deliver(ticket, std::move(evaluation));
            --held_[static_cast<std::size_t>(message.sender)];
        }
    }

    State& state_;
    std::span<Genome const* const> genomes_;
    Audience* audience_;
    std::vector<int> order_;
    int ranks_, lanes_, share_;
    std::vector<int> held_;    ///< by each worker, under way or waiting
    std::vector<int> taken_;   ///< by each worker so far
    int next_ = 0, done_ = 0;
    unsigned pulses_ = 0;
    double audience_seconds_ = 0;
};

Farm::Farm(Communicator communicator, StreamEvaluation evaluate)
    : state_(std::make_unique<State>(std::move(communicator), std::move(evaluate))) {}

Farm::~Farm() {
    if (state_->working) stop();
}

std::vector<Evaluation> Farm::evaluate(std::span<Genome const* const> genomes, Audience* audience) {
    try {
        return evaluate_everywhere(genomes, audience);
    } catch (...) {
        state_->give_up();   // whatever it was, other ranks may still be at work
        throw;
    }
}

std::vector<Evaluation> Farm::evaluate_everywhere(std::span<Genome const* const> genomes, Audience* audience) {
    State& state = *state_;
    Stopwatch watch;
    OwnFeed feed{state, genomes, audience};
    auto const book = [&](double& time) {   // what the audience took is another account's
        double const audience_seconds = feed.audience_lap();
        time += watch.lap() - audience_seconds;
        state.times.distances += audience_seconds;
    };
    auto const culprit = evaluate_guarded(state.evaluate, feed);
    book(state.times.evaluation);
    if (culprit)
        throw EvaluationFailure(feed.index(culprit->ticket), state.communicator.rank(), culprit->genome,
                                culprit->reason);
    feed.wait_for_others();
    book(state.times.waiting);
    if (feed.failure) throw *feed.failure;
    return std::move(feed.results);
}

void Farm::measure(DistanceKind kind, std::span<Descriptors const* const> pool, int known, DistanceMatrix& matrix) {
    State& state = *state_;
    if (state.communicator.size() > 1 && kind == DistanceKind::trajectory &&
        static_cast<int>(pool.size()) - known >= least_rows_to_share) {
        try {
            measure_together(state.post, state.communicator.size(), pool, known, matrix, state.times);
        } catch (...) {
            state.give_up();
            throw;
        }
        return;
    }
    Stopwatch watch;
    Evaluator::measure(kind, pool, known, matrix);
    state.times.distances += watch.lap();
}

bool Farm::broken() const { return state_->broken; }

std::vector<RankTimes> Farm::stop() {
    State& state = *state_;
    std::vector<RankTimes> times{state.times};
    if (!std::exchange(state.working, false)) return times;
    for (int worker = 1; worker < state.communicator.size(); ++worker)
        state.post.send(worker, MessageKind::stop, 0, {});
    times.resize(static_cast<std::size_t>(state.communicator.size()));
    MessageKind const kinds[]{MessageKind::times};
    for (int worker = 1; worker < state.communicator.size(); ++worker) {
        Message const message = state.post.await(kinds);
        std::memcpy(&times[static_cast<std::size_t>(message.sender)], message.payload.data(), sizeof(RankTimes));
    }
    state.post.flush();
    return times;
}

}   // namespace lore
