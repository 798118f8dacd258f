#pragma once

#include <lore/evaluation/evaluation.h>

#include <span>
#include <vector>

namespace lore {

/// Notified as evaluations complete, so that work on them can begin while other ranks still evaluate.
class CompletionListener {
public:
    virtual ~CompletionListener() = default;
    /// The evaluation of genomes[index] is complete. The reference is valid until evaluate() returns.
    virtual void completed(int index, Evaluation const&) = 0;
    /// This rank has nothing to do until another one reports.
    virtual void idle() {}
};

/// Genomes in, evaluations out. Evolution evaluates through this interface.
class Evaluator {
public:
    virtual ~Evaluator() = default;
    /// evaluations[i] belongs to genomes[i]. The caller keeps the genomes until it returns. Notifies the listener of
    /// some evaluations or none, each at most once, in any order, on the calling thread.
    virtual std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes, CompletionListener* = nullptr) = 0;
};

/// Evaluates in this process. Notifies no listener, because no other rank is at work meanwhile.
class SerialEvaluator : public Evaluator {
public:
    explicit SerialEvaluator(EvaluationContext context) : context_(std::move(context)) {}
    std::vector<Evaluation> evaluate(std::span<Genome const* const>, CompletionListener* = nullptr) override;

private:
    EvaluationContext context_;
};

}   // namespace lore
