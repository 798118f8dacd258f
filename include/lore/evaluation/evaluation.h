#pragma once

#include <lore/behavior/descriptors.h>
#include <lore/episode/episode.h>
#include <lore/knowledge/shaping.h>
#include <lore/network/genome.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lore {

/// What one individual's evaluation yields; its trace is not kept. A pure function of the context and the genome.
///
/// It travels from the evaluating rank to rank 0 (archive/messages.h).
struct Evaluation {
    double reward = 0;                   ///< the sum of the rewards [the world's reward_unit]
    double shaping = no_feature_value;   ///< RS; -1 without a knowledge base, and where the pool decides (rule share)
    std::vector<std::uint32_t> shown;    ///< rule share: the features shown, each once, in increasing order
    Descriptors descriptors;
    friend bool operator==(Evaluation const&, Evaluation const&) = default;
};

/// What a rank needs to evaluate: immutable, equal on all ranks.
struct EvaluationContext {
    std::shared_ptr<World const> world;
    EpisodeConfig episode;
    std::optional<Shaper> shaper;   ///< of the treatment's knowledge base, if it has one
};

/// The plain definition: one controller, one step at a time, from its recorded trace.
Evaluation evaluate_plainly(EvaluationContext const&, Genome const&);

/// Many at once, in lanes; equal to evaluate_plainly to the bit. evaluations[i] belongs to genomes[i]. The caller keeps
/// the genomes until it returns.
std::vector<Evaluation> evaluate_batch(EvaluationContext const&, std::span<Genome const* const> genomes);

}   // namespace lore
