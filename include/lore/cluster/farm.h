#pragma once

#include <lore/cluster/session.h>
#include <lore/core/error.h>
#include <lore/behavior/distance_measurer.h>
#include <lore/evaluation/evaluator.h>

#include <memory>
#include <string>
#include <vector>

namespace lore {

/// An evaluation that threw, on any rank.
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
    double distances = 0;   ///< on rank 0 with the listener's time while other ranks evaluate
    double waiting = 0;     ///< polling for messages; on rank 0 only while a request is under way
    double processor = 0;   ///< processor_seconds() as the farm stops
};

/// The ranks of a communicator, at work for rank 0. The others are in serve() with an equal context.
///
/// Both interfaces send their parts to all ranks and work on rank 0 too. Any number of ranks gives the results that one
/// gives, in the order of the request. Used by one thread, one request at a time.
class Farm {
public:
    Farm(Communicator, EvaluationContext);
    /// Stops the workers, unless broken().
    ~Farm();

    /// Valid as long as the farm. evaluate() throws EvaluationFailure, and notifies its listener of every evaluation if
    /// there are other ranks.
    Evaluator& evaluator();
    /// Valid as long as the farm. measure() throws Error if another rank fails.
    DistanceMeasurer& distances();

    /// A request has failed while other ranks were at work: the program must end by Session::abort.
    bool broken() const;
    /// Ends serve() on the other ranks; returns what each rank, in order, spent its time on. No request may follow.
    std::vector<RankTimes> stop();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Works for the Farm on rank 0 until it stops. Sends failures there.
void serve(Communicator const&, EvaluationContext);

}   // namespace lore
