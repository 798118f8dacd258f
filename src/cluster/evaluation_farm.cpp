#include "evaluation_farm.h"

#include "share.h"

#include <lore/archive/messages.h>
#include <lore/core/stopwatch.h>
#include <lore/episode/lanes.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lore {

namespace {

constexpr int most_in_a_message = 10;   ///< genomes; about 3 kB, which MPI sends without asking first

/// A request that all ranks work on: fills the lanes of rank 0 and, between their steps, serves the other ranks.
class SharedRequest : public EvaluationQueue {
public:
    SharedRequest(FarmState& state, std::span<Genome const* const> genomes, CompletionListener* listener)
        : request(genomes), state_(state), listener_(listener), lanes_(lane_count()),
          share_(share_of_a_worker(request.size(), state.ranks(), lanes_)),
          held_(static_cast<std::size_t>(state.ranks()), 0), taken_(held_) {
        hand_out();
    }

    std::optional<Item> next() override {
        if (left() == 0) return std::nullopt;
        int const ticket = request.next_ticket();
        request.hand_out(1);
        return Item{ticket, &request.genome(ticket)};
    }
    void deliver(int ticket, Evaluation evaluation) override {
        Evaluation const& result = request.deliver(ticket, std::move(evaluation));
        if (state_.ranks() == 1 || listener_ == nullptr || failure) return;
        Stopwatch watch;
        listener_->completed(request.index(ticket), result);
        listener_seconds_ += watch.lap();
    }
    void pulse() override {
        if (++pulses_ % pulses_a_look != 0) return;
        while (auto message = state_.post.receive(kinds)) take(*message);
        hand_out();
    }

    /// Receives what other ranks still evaluate, until the request is complete or has failed.
    void wait_for_others() {
        while (!request.complete() && !failure) {
            auto message = state_.post.receive(kinds);
            if (!message && listener_ != nullptr) {
                Stopwatch watch;
                listener_->idle();
                listener_seconds_ += watch.lap();
            }
            take(message ? *message : state_.post.await(kinds));
            hand_out();
        }
    }
    /// Spent in the listener since the last call [s].
    double listener_lap() { return std::exchange(listener_seconds_, 0.0); }

    Request request;
    /// Of another rank. Thrown by the farm; thrown from here it would look like a failure of this rank's lanes.
    std::optional<EvaluationFailure> failure;

private:
    static constexpr MessageKind kinds[]{MessageKind::evaluated, MessageKind::failure};

    int left() const { return failure ? 0 : request.left(); }

    /// Keeps the next set waiting at every worker until it has had its share. A worker that is out of work after that
    /// gets more, half a set at a time.
    void hand_out() {
        for (int worker = 1; worker < state_.ranks(); ++worker) {
            int const held = held_[static_cast<std::size_t>(worker)], taken = taken_[static_cast<std::size_t>(worker)];
            int const due = held == 0 && taken >= share_ ? lanes_ / 2 : std::min(share_ - taken, 2 * lanes_ - held);
            for (int batch_left = std::min(due, left()); batch_left > 0; batch_left -= most_in_a_message)
                send(worker, std::min(batch_left, most_in_a_message));
        }
    }

    void send(int worker, int count) {
        int const first = request.next_ticket();
        std::vector<Genome const*> batch;
        for (int ticket = first; ticket < first + count; ++ticket) batch.push_back(&request.genome(ticket));
        state_.post.send(worker, MessageKind::evaluate, first, pack_genomes(batch));
        request.hand_out(count);
        held_[static_cast<std::size_t>(worker)] += count;
        taken_[static_cast<std::size_t>(worker)] += count;
    }

    void take(Message const& message) {
        if (message.kind == MessageKind::failure) {
            if (!failure)
                failure.emplace(request.index(message.unit), message.sender, request.genome(message.unit),
                                text_of(message));
            return;
        }
        for (auto& [ticket, evaluation] : unpack_deliveries(message.payload)) {
            if (ticket >= request.next_ticket())
                throw damaged_message("it answers for a genome that no rank was given");
            deliver(ticket, std::move(evaluation));
            --held_[static_cast<std::size_t>(message.sender)];
        }
    }

    FarmState& state_;
    CompletionListener* listener_;
    int lanes_, share_;
    std::vector<int> held_;    ///< by each worker, in its lanes or waiting
    std::vector<int> taken_;   ///< by each worker so far
    unsigned pulses_ = 0;
    double listener_seconds_ = 0;
};

}   // namespace

std::vector<Evaluation> EvaluationFarm::evaluate(std::span<Genome const* const> genomes, CompletionListener* listener) {
    try {
        return evaluate_everywhere(genomes, listener);
    } catch (...) {
        state_.give_up();
        throw;
    }
}

std::vector<Evaluation> EvaluationFarm::evaluate_everywhere(std::span<Genome const* const> genomes,
                                                            CompletionListener* listener) {
    Stopwatch watch;
    SharedRequest shared{state_, genomes, listener};
    auto const book = [&](double& time) {   // the listener measures distances
        double const listener_seconds = shared.listener_lap();
        time += watch.lap() - listener_seconds;
        state_.times.distances += listener_seconds;
    };
    auto const culprit = lanes_.evaluate(shared);
    book(state_.times.evaluation);
    if (culprit)
        throw EvaluationFailure(shared.request.index(culprit->ticket), state_.communicator.rank(), culprit->genome,
                                culprit->reason);
    shared.wait_for_others();
    book(state_.times.waiting);
    if (shared.failure) throw *shared.failure;
    return std::move(shared.request).results();
}

}   // namespace lore
