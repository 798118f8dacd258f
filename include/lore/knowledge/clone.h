#pragma once

#include <lore/knowledge/knowledge_base.h>
#include <lore/network/genome.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace lore {

/// How founders are cloned from a knowledge base (docs/design/model.md, "Founders cloned from knowledge").
struct CloneConfig {
    int count = 200;     ///< founders
    int windows = 400;   ///< drawn for each founder, with replacement: 8000 pairs of 20 steps each
    int hidden = 0;      ///< hidden neurons; their input weights and biases are random, only what reads them is fitted
    std::uint64_t seed = 1;
};
/// Steps of the windows drawn for one founder: they lie in memory together [steps].
inline constexpr int most_cloned_steps = 1'000'000;
/// Hidden neurons that clones may have: one from each sensor to each effector, and one from and to each of them for
/// every hidden neuron, are the connections of a clone.
int most_cloned_hidden(Channels const&);   ///< at most most_hidden

/// How well one effector is imitated.
struct EffectorFit {
    double cross_entropy = 0;    ///< mean of -t log y - (1 - t) log(1 - y) over the pairs [nats]
    double absolute_error = 0;   ///< mean of |y - t| over the pairs
};

struct Clones {
    std::vector<Genome> genomes;
    std::vector<EffectorFit> fit;        ///< per effector, of the genomes' own weights, mean over the founders
    std::vector<EffectorFit> constant;   ///< of the best constant output (each founder's own mean)
    bool all_alike = false;   ///< no value stands out, so that every feature was drawn with the same probability
};

/// Imitation by value: each founder gets weights and biases that minimize the cross-entropy between the effectors and
/// what it gives for the sensors, over all steps of windows drawn from the base with probability proportional to their
/// feature's value (less the smallest one, where that is negative). Founder i draws from the stream (seed, clone, 0,
/// i). A pure function of base and config, the same bits on every machine. `observer` hears how many founders are done.
/// Throws UsageError: no features, or a number of founders, windows or hidden neurons that is out of range.
Clones clone(KnowledgeBase const&, CloneConfig const&, std::function<void(int)> const& observer = {});

}   // namespace lore
