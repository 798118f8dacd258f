#include "guarded_evaluation.h"

#include <lore/core/error.h>

#include <exception>
#include <map>
#include <new>
#include <utility>

namespace lore {

namespace {

/// Remembers which genomes are in the lanes, and what the queue itself has thrown.
class WatchedQueue : public EvaluationQueue {
public:
    WatchedQueue(EvaluationQueue& queue, TestHooks& hooks) : queue_(queue), hooks_(hooks) {}
    std::optional<Item> next() override {
        std::optional<Item> item;
        guard([&] { item = queue_.next(); });
        if (!item) return item;
        in_lanes.emplace(item->ticket, *item->genome);
        hooks_.before_evaluation(*item->genome);
        return item;
    }
    void deliver(int ticket, Evaluation evaluation) override {
        hooks_.before_delivery(evaluation);
        in_lanes.erase(ticket);
        guard([&] { queue_.deliver(ticket, std::move(evaluation)); });
    }
    void pulse() override {
        guard([&] { queue_.pulse(); });
    }

    std::map<int, Genome> in_lanes;     ///< by ticket
    std::exception_ptr queue_failure;   ///< a message that is damaged, memory for an answer: no genome's fault

private:
    template <class Call>
    void guard(Call const& call) {
        try {
            call();
        } catch (...) {
            queue_failure = std::current_exception();
            throw;
        }
    }

    EvaluationQueue& queue_;
    TestHooks& hooks_;
};

class SingleGenome : public EvaluationQueue {
public:
    explicit SingleGenome(Genome const& genome) : genome_(&genome) {}
    std::optional<Item> next() override {
        if (genome_ == nullptr) return std::nullopt;
        return Item{0, std::exchange(genome_, nullptr)};
    }
    void deliver(int, Evaluation) override {}

private:
    Genome const* genome_;
};

std::string reason_of_current_exception() {
    try {
        throw;
    } catch (std::bad_alloc const&) { return "out of memory"; } catch (std::exception const& error) {
        return error.what();
    } catch (...) { return "an exception of unknown type"; }
}

}   // namespace

std::optional<Culprit> GuardedEvaluation::evaluate(EvaluationQueue& queue) {
    WatchedQueue watched{queue, hooks_};
    std::string reason;
    try {
        evaluate_queue(context_, watched);
        return std::nullopt;
    } catch (...) { reason = reason_of_current_exception(); }
    if (watched.queue_failure) std::rethrow_exception(watched.queue_failure);
    if (watched.in_lanes.empty()) throw Error("an evaluation failed", reason, "Resume the run.");
    for (auto const& [ticket, genome] : watched.in_lanes) {
        try {
            SingleGenome single{genome};
            WatchedQueue again{single, hooks_};
            evaluate_queue(context_, again);
        } catch (...) { return Culprit{ticket, genome, reason_of_current_exception()}; }
    }
    auto const& [ticket, genome] = *watched.in_lanes.begin();
    return Culprit{ticket, genome, reason + ", but none of those under way fails alone"};
}

}   // namespace lore
