#pragma once

#include <lore/knowledge/index.h>

namespace lore {

/// What an individual showed, and what it earned.
struct Exhibit {
    std::vector<Window> windows;
    double reward = 0;
    std::span<Reward const> rewards = {};   ///< as Trace::rewards; of discounted returns
    std::uint32_t generation = 0;           ///< of its birth; of contrast
};

class EvidenceGatherer;

/// Algorithm 1, one individual at a time. The caller brings the individuals in order: the best-of-run first, then its
/// parent, and so on to the founder; or all ever evaluated in order of birth ("KB all").
class KnowledgeBuilder {
public:
    /// `index` is empty and was made for the same configuration.
    KnowledgeBuilder(KnowledgeConfig, std::unique_ptr<GrowingIndex> index, EvidenceConfig = {});
    ~KnowledgeBuilder();
    KnowledgeBuilder(KnowledgeBuilder&&) noexcept;
    /// Adds what this individual exhibits; each feature gets its reward once however often it was shown.
    void add_individual(Exhibit const& exhibit);
    /// As add_individual for each in order; the crew shares the search where the index can.
    void add_individuals(std::span<Exhibit const>, Crew&);
    int features() const { return static_cast<int>(counts_.size()); }
    std::uint64_t individuals() const { return individuals_; }
    std::uint64_t windows() const { return windows_; }
    std::uint64_t matched() const { return matched_; }   ///< windows that were in the base already
    /// Values by rule mean. Provenance::individuals, ::windows and ::value are filled in here.
    KnowledgeBase finish(Provenance) &&;

private:
    void add_feature();
    void show(int feature, std::size_t window, double reward);

    KnowledgeConfig config_;
    std::unique_ptr<GrowingIndex> index_;
    std::vector<double> sums_;
    std::vector<std::uint32_t> counts_;
    std::unique_ptr<EvidenceGatherer> evidence_;   ///< null if none is wanted
    std::vector<std::uint64_t> last_exhibitor_;    ///< per feature, so that an individual counts once
    std::uint64_t individuals_ = 0, windows_ = 0, matched_ = 0;
};

}   // namespace lore
