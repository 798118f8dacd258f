#pragma once

#include <lore/evolution/evolution.h>

#include <cstdint>

namespace lore {

/// One generation in figures, a row of progress.csv; of the survivors unless said otherwise.
/// A new figure is a line here, one in summarize, and one in the columns of progress.csv.
struct GenerationSummary {
    int generation = 0;
    double best_reward = 0;   ///< [the world's reward_unit]
    double mean_reward = 0;
    DistanceKind distance = DistanceKind::adhoc;
    bool shaping_serves = false;   ///< RS stood in the place of BD
    double mean_diversity = 0;     ///< BD
    double best_shaping = no_feature_value;
    double mean_connections = 0;
    double mean_hidden = 0;
    int fronts = 0;                  ///< of the joint ranking
    int tied = 0;                    ///< survivors that share all objectives with another one
    double shaping_at_max = 0;       ///< share that holds the best shaping value; 0 if no survivor matched one
    std::uint64_t evaluations = 0;   ///< in this generation; in progress.csv, since the run began
    std::uint64_t steps = 0;         ///< recorded by these evaluations, likewise [steps]
    double seconds = 0;              ///< of wall time since the run began, in all sessions [s]; not told by a report

    friend bool operator==(GenerationSummary const&, GenerationSummary const&) = default;
};

/// A pure function of these; seconds stay 0. `nothing_shown`: RS of an individual that shows no feature, by rule max.
GenerationSummary summarize(GenerationReport const&, double nothing_shown = no_feature_value);

}   // namespace lore
