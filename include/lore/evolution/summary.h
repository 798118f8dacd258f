#pragma once

#include <lore/evolution/evolution.h>

#include <cstdint>

namespace lore {

/// One generation in figures, as progress.csv tells it; of the survivors unless said otherwise.
struct GenerationSummary {
    int generation = 0;
    int best_balls = 0;
    double mean_balls = 0;
    DistanceKind distance = DistanceKind::adhoc;
    double mean_diversity = 0;
    double best_shaping = no_feature_value;
    double mean_connections = 0;
    double mean_hidden = 0;
    int fronts = 0;                 ///< of the joint ranking
    int tied = 0;                   ///< survivors that share all objectives with another one
    double shaping_at_max = 0;      ///< share that holds the best shaping value; 0 where nobody matched a feature
    std::int64_t evaluations = 0;   ///< in this generation
    std::int64_t steps = 0;         ///< recorded by these evaluations [steps]
};

/// A pure function of the report.
GenerationSummary summarize(GenerationReport const&);

}   // namespace lore
