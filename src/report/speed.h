#pragma once

#include <lore/campaign/plan.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// The balls whose first collection is timed.
inline constexpr std::array<int, 3> timed_balls{1, 3, 5};

/// When the runs of a treatment first have so many balls. A run's time is the first generation whose best individual
/// has them, and `generations` of SpeedRow where that is later or never: the mean is the restricted mean (Irwin 1949).
struct TimeToBalls {
    int reached = 0;            ///< runs that have them by then
    double mean = 0;            ///< [generations]
    double low = 0, high = 0;   ///< 95 % percentile bootstrap interval of the mean
    double median = 0;          ///< of the same times [generations]
};

/// How fast a treatment's runs improve: a row of speed.csv.
struct SpeedRow {
    std::string treatment;
    int runs = 0;
    int generations = 0;   ///< those that the runs of all target treatments have; later ones do not count
    std::array<TimeToBalls, timed_balls.size()> to;   ///< of timed_balls
    double area = 0;   ///< under the mean curve of best balls, from generation 0 [balls x generations]: trapezoids
    double area_low = 0, area_high = 0;   ///< 95 % percentile bootstrap interval
};

/// `curves`: best balls by generation, from 0, a run each. Precondition: at least one, and each has the generations
/// 0 to `generations`.
SpeedRow speed_of(std::string treatment, std::span<std::vector<int> const> curves, int generations);

/// The mean best balls of a treatment's runs at one generation.
struct Milestone {
    std::string treatment;
    int generation = 0;
    double balls = 0;
};

/// How much of a policy's lead over no transfer another treatment has at one generation: a row of leads.csv.
struct LeadRow {
    std::string treatment;
    std::string policy;   ///< the treatment whose founders come from the source run of the same base
    std::string none;     ///< the treatment that takes nothing from the source
    int generation = 0;
    double balls = 0, policy_balls = 0, none_balls = 0;   ///< means over the runs
    double share = 0;                                     ///< (balls - none_balls) / (policy_balls - none_balls)
};

/// Every target treatment that takes a base beside the policy treatment of the same source run, at the generations of
/// the milestones, in the report's order. Left out are generations at which the policy does not lead. No transfer is
/// the first treatment in that order that takes nothing, with the policy's configuration.
std::vector<LeadRow> leads_of(CampaignPlan const&, std::vector<Milestone> const&);

}   // namespace lore
