#pragma once

#include <lore/knowledge/evidence.h>
#include <lore/knowledge/window.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// Where a knowledge base came from; goes into its file and is shown by `lore-kb info`.
struct Provenance {
    std::string made_by;                   ///< command line and version
    std::string kind;                      ///< "lineage", "all", "random", "permuted", "reduced", "revalued"
    std::string index;                     ///< "exact" or "flann": the index that found the matches while building
    std::vector<std::string> sources;      ///< runs or knowledge bases it was made from
    std::vector<std::string> derivation;   ///< what was done to it since it was built, in order
    std::string task;                      ///< the world's and task's name
    std::string reward_unit = "balls";     ///< of that world
    std::string value;                     ///< the rule that gave the values (knowledge/value.h); empty: mean
    std::uint64_t individuals = 0;         ///< whose windows were read
    std::uint64_t windows = 0;
    double best_reward = 0;   ///< of the best-of-run whose lineage it is
    friend bool operator==(Provenance const&, Provenance const&) = default;
};

/// The arrays of a knowledge base while it is being made.
struct KnowledgeArrays {
    std::vector<std::uint16_t> bits;     ///< [feature][step][word], the bits of binary channels alone
    std::vector<float> windows;          ///< [feature][step][continuous channel]
    std::vector<double> values;          ///< [feature]
    std::vector<double> reward_sums;     ///< [feature]
    std::vector<std::uint32_t> counts;   ///< [feature]
    EvidenceArrays evidence = {};
};

/// Behavioral features and the rewards of the individuals that showed them (paper, "Knowledge building process").
///
/// Feature i has the window (bits, values)[i] and evidence: the rewards' sum and the number of individuals that
/// exhibited it, and what else the build gathered. Its value is derived from the evidence by a rule, sum / count unless
/// another was chosen (knowledge/value.h), or it is what randomize gave it; any finite number, negative ones too.
/// Features are numbered in the order in which they were first met. Flat arrays that may live in a mapped file shared
/// by the ranks of one node; immutable, cheap to copy.
class KnowledgeBase {
public:
    KnowledgeConfig const& config() const { return parts_.config; }
    Provenance const& provenance() const { return parts_.provenance; }
    int size() const { return static_cast<int>(parts_.values.size()); }

    Window window(int feature) const;   ///< valid as long as the knowledge base
    double value(int feature) const {
        return parts_.values[static_cast<std::size_t>(feature)];
    }   ///< r_i [reward unit]
    double reward_sum(int feature) const { return parts_.reward_sums[static_cast<std::size_t>(feature)]; }
    std::uint32_t count(int feature) const {
        return parts_.counts[static_cast<std::size_t>(feature)];
    }   ///< individuals that exhibited it
    std::span<double const> values() const { return parts_.values; }
    Evidence const& evidence() const { return parts_.evidence; }

    /// The parts of a knowledge base; `keep_alive` owns the memory behind the spans (vectors, or a mapped file).
    struct Parts {
        KnowledgeConfig config;
        Provenance provenance;
        std::span<std::uint16_t const> bits;     ///< [feature][step][word], the bits of binary channels alone
        std::span<float const> windows;          ///< [feature][step][continuous channel]
        std::span<double const> values;          ///< [feature]
        std::span<double const> reward_sums;     ///< [feature]
        std::span<std::uint32_t const> counts;   ///< [feature]
        std::shared_ptr<void const> keep_alive;
        Evidence evidence = {};
    };
    explicit KnowledgeBase(Parts);
    /// One that owns its arrays.
    KnowledgeBase(KnowledgeConfig, Provenance, KnowledgeArrays);
    Parts const& parts() const { return parts_; }
    /// The same features with other values; shares all other memory. Precondition: one value a feature.
    KnowledgeBase with_values(std::vector<double> values, Provenance) const;

private:
    Parts parts_;
};

}   // namespace lore
