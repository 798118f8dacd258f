#pragma once

#include "results.h"
#include <lore/statistics/bootstrap.h>

#include <string>
#include <vector>

namespace lore {

/// Two treatments compared by their runs' rewards at the end: a row of pvalues.csv.
struct Comparison {
    std::string a, b;
    int n_a = 0, n_b = 0;
    double u = 0;        ///< Mann-Whitney, of `a`
    double p = 1;        ///< two-sided
    double p_holm = 1;   ///< corrected over all pairs that this campaign compares
    double a12 = 0.5;    ///< probability that a run of `a` beats one of `b`
    Interval a12_band;   ///< its 95 % bootstrap interval; not in pvalues.csv
    bool exact = false;
};

/// All pairs of target treatments that have runs, in the report's order; where the campaign's file names target tasks,
/// pairs of one task.
std::vector<Comparison> compare_treatments(CampaignPlan const&, Results const&);
std::string comparisons_csv(std::vector<Comparison> const&);

/// The comparisons that the campaign's pools name, in their order; p_holm is corrected over these alone.
std::vector<Comparison> compare_pools(CampaignPlan const&, Results const&);
/// pools.csv: the same columns, and the bounds of A12's interval.
std::string pools_csv(std::vector<Comparison> const&);
/// Rewards at the end of all runs of a treatment or a pool, in the order of final.csv.
std::vector<double> rewards_of(CampaignPlan const&, Results const&, std::string_view name);

/// The paper's marks: "**" for p < 1e-3, "*" for p < 1e-2, else "".
std::string_view significance_mark(double p);
/// A p-value for people: "0.043", "3.1e-05".
std::string p_text(double p);

}   // namespace lore
