#pragma once

#include <lore/campaign/plan.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// Those that are timed where the reward has the unit of the first worlds.
inline constexpr std::array<double, 3> first_reward_levels{1, 3, 5};

/// When the runs of a treatment first have so much reward. A run's time is the first generation whose best individual
/// has it, and `generations` of SpeedRow where that is later or never: the mean is the restricted mean (Irwin 1949).
struct TimeToLevel {
    double level = 0;           ///< [reward unit]
    int reached = 0;            ///< runs that have it by then
    double mean = 0;            ///< [generations]
    double low = 0, high = 0;   ///< 95 % percentile bootstrap interval of the mean
    double median = 0;          ///< of the same times [generations]
};

/// How fast a treatment's runs improve: a row of speed.csv.
struct SpeedRow {
    std::string treatment;
    int runs = 0;
    int generations = 0;   ///< those that the runs of all target treatments have; later ones do not count
    std::vector<TimeToLevel> to;
    double area = 0;   ///< under the mean curve of the best reward, from generation 0 [reward unit x generations]:
                       ///< trapezoids
    double area_low = 0, area_high = 0;   ///< 95 % percentile bootstrap interval
};

/// `curves`: best reward by generation, from 0, a run each; `levels`: those that are timed. Precondition: at least one,
/// and each has the generations 0 to `generations`.
SpeedRow speed_of(std::string treatment, std::span<std::vector<double> const> curves, int generations,
                  std::span<double const> levels);

/// The levels that a campaign file names in [report]. Else those of the first worlds, 1, 3 and 5, for their unit; for
/// others 25, 50 and 75 % of the way from the worst to the best of `finals`, all runs' rewards at the end; none where
/// these are equal.
std::vector<double> timed_levels(CampaignPlan const&, std::string_view reward_unit, std::span<double const> finals);

/// The mean best reward of a treatment's runs at one generation.
struct Milestone {
    std::string treatment;
    int generation = 0;
    double reward = 0;
};

/// How much of a policy's lead over no transfer another treatment has at one generation: a row of leads.csv.
struct LeadRow {
    std::string treatment;
    std::string policy;   ///< the treatment whose founders come from the source runs of the same bases
    std::string none;     ///< the treatment that takes nothing from the source
    int generation = 0;
    double reward = 0, policy_reward = 0, none_reward = 0;   ///< means over the runs
    double share = 0;                                        ///< (reward - none_reward) / (policy_reward - none_reward)
};

/// Every target treatment that takes bases beside the policy treatment of the same source runs, at the generations of
/// the milestones, in the report's order. Left out are generations at which the policy does not lead. No transfer is
/// the first treatment in that order that takes nothing, with the policy's configuration and overrides.
std::vector<LeadRow> leads_of(CampaignPlan const&, std::vector<Milestone> const&);

}   // namespace lore
