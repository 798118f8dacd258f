#pragma once

#include <lore/behavior/distance_matrix.h>
#include <lore/knowledge/shaping.h>
#include <lore/network/genome.h>

#include <optional>
#include <span>
#include <vector>

namespace lore {

/// All that an individual's life in the arena leaves behind; the trace itself dies where it was born.
struct Evaluation {
    int balls = 0;                       ///< delivered into the basket
    double shaping = no_feature_value;   ///< RS; -1 without a knowledge base, and where the pool decides (rule share)
    std::vector<std::uint32_t> shown;    ///< rule share: the features shown, each once, in increasing order
    Descriptors descriptors;
    friend bool operator==(Evaluation const&, Evaluation const&) = default;
};

/// What every rank needs to evaluate; immutable, equal on all ranks.
struct EvaluationContext {
    Arena arena;
    EpisodeConfig episode;
    std::optional<Shaper> shaper;
};

/// The plain definition: one controller, one step at a time, from its recorded trace.
Evaluation evaluate_plainly(EvaluationContext const&, Genome const&);
/// The fast path: many at once, in lanes; equal to the plain one to the bit.
std::vector<Evaluation> evaluate_batch(EvaluationContext const&, std::span<Genome const* const>);

/// Genomes that come, and evaluations that go, while others are under way.
class EvaluationFeed {
public:
    virtual ~EvaluationFeed() = default;
    struct Item {
        int ticket = 0;                   ///< told back with the evaluation
        Genome const* genome = nullptr;   ///< read at once
    };
    /// The next genome, if there is one now; asked again every few microseconds while a lane is idle. Cheapest if
    /// genomes of similar size follow each other.
    virtual std::optional<Item> next() = 0;
    virtual void deliver(int ticket, Evaluation) = 0;
    /// Called every few microseconds, for whoever has other things to look after.
    virtual void pulse() {}
};
/// The order in which a feed should hand out what it has.
bool larger(Genome const&, Genome const&);
/// The same as evaluate_batch, until nothing is under way and the feed has no more.
void evaluate_stream(EvaluationContext const&, EvaluationFeed&);

/// Whoever can do something about evaluations while others are still under way elsewhere, where it costs no time.
class Audience {
public:
    virtual ~Audience() = default;
    /// genomes[index] has been evaluated. The evaluation stays where it is until evaluate() returns.
    virtual void arrive(int index, Evaluation const&) = 0;
    /// There is nothing else to do until the next one arrives.
    virtual void lull() {}
};

/// Genomes in, evaluations out, whoever does the work. Evolution sees only this.
class Evaluator {
public:
    virtual ~Evaluator() = default;
    /// evaluations[i] belongs to genomes[i]. Announces some of them early, in any order, or none.
    virtual std::vector<Evaluation> evaluate(std::span<Genome const* const>, Audience* = nullptr) = 0;
    /// Fills every pair (i, j) with i >= known, j < i. The default does it here; a farm shares the rows.
    virtual void measure(DistanceKind, std::span<Descriptors const* const> pool, int known, DistanceMatrix&);
};

/// In this process alone.
class SerialEvaluator : public Evaluator {
public:
    explicit SerialEvaluator(EvaluationContext context) : context_(std::move(context)) {}
    /// Announces nothing: nobody else is at work.
    std::vector<Evaluation> evaluate(std::span<Genome const* const>, Audience* = nullptr) override;

private:
    EvaluationContext context_;
};

}   // namespace lore
