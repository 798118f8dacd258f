#pragma once

#include <lore/evaluation/evaluation.h>

#include <optional>
#include <span>
#include <vector>

namespace lore {

/// Where the lanes of one rank get genomes and put evaluations. Genomes may arrive while others are evaluated.
class EvaluationQueue {
public:
    virtual ~EvaluationQueue() = default;
    struct Item {
        int ticket = 0;                   ///< names the genome at delivery
        Genome const* genome = nullptr;   ///< valid until the next call of next()
    };
    /// The next genome, or nothing if none waits now; asked every few microseconds while a lane is idle. Lanes cost
    /// what the largest network among them costs, so genomes of similar size should follow each other.
    virtual std::optional<Item> next() = 0;
    /// Takes the evaluation of an item. Called once for each, in any order.
    virtual void deliver(int ticket, Evaluation) = 0;
    /// Called every few microseconds while lanes run, so that the owner can look after other ranks.
    virtual void pulse() {}
};

/// Evaluates in lanes until no lane runs and the queue has no more; each evaluation equals evaluate_plainly to the bit.
/// Passes on what the queue throws; genomes that were taken and not delivered are then lost.
void evaluate_queue(EvaluationContext const&, EvaluationQueue&);

/// The genomes of one request, in the order in which lanes should get them, and their evaluations.
///
/// A ticket is a genome's place in that order: the largest network first. The caller keeps the genomes as long as the
/// request.
class Request {
public:
    explicit Request(std::span<Genome const* const> genomes);

    int size() const { return static_cast<int>(genomes_.size()); }
    Genome const& genome(int ticket) const { return *genomes_[static_cast<std::size_t>(index(ticket))]; }
    /// The genome's place in the request.
    int index(int ticket) const { return order_[static_cast<std::size_t>(ticket)]; }

    /// The ticket that is handed out next; so many have been. Equals size() at the end.
    int next_ticket() const { return next_; }
    int left() const { return size() - next_; }
    /// Counts the next `count` tickets as handed out; at most left().
    void hand_out(int count) { next_ += count; }

    /// Keeps the evaluation of a ticket that was handed out; once for each. The reference is valid until results().
    Evaluation const& deliver(int ticket, Evaluation);
    bool complete() const { return done_ == size(); }
    /// evaluations[i] belongs to genomes[i]. The request must be complete.
    std::vector<Evaluation> results() &&;

private:
    std::span<Genome const* const> genomes_;
    std::vector<int> order_;   ///< indices into genomes_
    std::vector<Evaluation> evaluations_;
    int next_ = 0, done_ = 0;
};

}   // namespace lore
