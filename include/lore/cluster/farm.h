#pragma once

#include <lore/cluster/session.h>
#include <lore/core/error.h>
#include <lore/evaluation/evaluator.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lore {

/// How a rank evaluates: evaluate_stream with a context bound to it.
using StreamEvaluation = std::function<void(EvaluationFeed&)>;

/// An evaluation that threw, on whatever rank.
class EvaluationFailure : public Error {
public:
    EvaluationFailure(int index, int rank, Genome genome, std::string reason);
    int index() const { return index_; }   ///< in the request
    int rank() const { return rank_; }
    Genome const& genome() const { return genome_; }
    std::string const& reason() const { return reason_; }

private:
    int index_, rank_;
    Genome genome_;
    std::string reason_;
};

/// Where a rank's time went [s].
struct RankTimes {
    double evaluation = 0;
    double distances = 0;   ///< of rank 0 with all that it does about evaluations that arrive
    double waiting = 0;     ///< with nothing to do but poll; of rank 0 while a request was under way
};

/// The ranks of a communicator as one Evaluator, on rank 0. The others are in serve().
///
/// Rank 0 hands genomes to its own lanes one by one and to the others in sets that fill their lanes, one set ahead; it
/// looks after them every few microseconds. A set takes the same time however few it holds, so workers are given whole
/// ones as long as possible, and rank 0, which has other things to do, what is left.
/// Results come back in the order of the request whoever made them: any number of ranks gives what one gives.
class Farm : public Evaluator {
public:
    Farm(Communicator, StreamEvaluation);
    /// Stops the workers, unless broken().
    ~Farm() override;

    /// Throws EvaluationFailure. With other ranks at work, announces every evaluation.
    std::vector<Evaluation> evaluate(std::span<Genome const* const>, Audience* = nullptr) override;
    /// Trajectory distances are shared, row ranges of equal area; the others take less time than their descriptors'
    /// way.
    void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&) override;

    /// A failure has been thrown while other ranks were at work: the program must end by Session::abort.
    bool broken() const;
    /// Sends the workers home; returns what each rank, in order, spent its time on. No request may follow.
    std::vector<RankTimes> stop();

private:
    struct State;
    class OwnFeed;
    std::vector<Evaluation> evaluate_everywhere(std::span<Genome const* const>, Audience*);
    std::unique_ptr<State> state_;
};

/// Works for the Farm on rank 0 until it stops.
void serve(Communicator const&, StreamEvaluation const&);

}   // namespace lore
