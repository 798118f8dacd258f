#pragma once

#include <lore/knowledge/builder.h>

namespace lore {

/// Sums up the evidence of a build while the builder tells which individual shows which feature. Calls, per individual:
/// begin, show for each of its windows in order, end; add_feature before a new feature is shown.
class EvidenceGatherer {
public:
    EvidenceGatherer(EvidenceConfig, int window_length);
    void add_feature();
    void begin(Exhibit const&);
    /// `window`: its number within the individual; `first`: the individual has not shown this feature before.
    void show(int feature, std::size_t window, bool first);
    void end();
    EvidenceArrays finish() &&;

private:
    struct Counts {
        std::uint32_t successes = 0, failures = 0;
    };
    void credit_child();
    void count_in_era();
    void end_era();

    EvidenceConfig config_;
    int window_length_;
    std::uint64_t individual_ = 0;   ///< numbered from 1
    double reward_ = 0;
    std::vector<int> shown_;   ///< by this individual, each once

    std::vector<std::uint64_t> showings_;
    std::vector<std::vector<double>> return_sums_;   ///< [gamma][feature]
    std::vector<std::vector<double>> returns_;       ///< [gamma][window] of this individual
    bool has_returned_ = false;                      ///< this individual has got a reward

    std::vector<std::uint32_t> news_;
    std::vector<double> gain_sums_;
    std::vector<std::uint64_t> last_shown_by_;
    std::vector<int> shown_by_child_;
    double child_reward_ = 0;

    std::vector<Counts> in_all_, in_era_;   ///< [feature]
    std::vector<int> touched_;              ///< features with counts in this era
    Counts era_all_;
    std::uint64_t successes_ = 0, failures_ = 0;
    int era_ = 0;
};

}   // namespace lore
