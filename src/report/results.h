#pragma once

#include "speed.h"

#include <lore/campaign/replay.h>
#include <lore/world/reward_text.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lore {

/// A finished run: a row of final.csv (treatment to reward) and of runs.csv.
struct RunRow {
    std::string treatment;
    int run = 0;
    std::uint64_t seed = 0;
    double reward = 0;   ///< of its best-of-run
    int generations = 0;
    std::uint64_t evaluations = 0;
    std::string signature;
    std::string version;   ///< of Lore, with its commit
    std::string reward_unit{first_reward_unit};
};

/// The mean best-of-run of the finished runs of a treatment, or of a pool of them, at one generation: a row of
/// curves.csv.
struct CurveRow {
    std::string treatment;
    int generation = 0;
    int runs = 0;
    double mean = 0;            ///< [reward unit]
    double low = 0, high = 0;   ///< 95 % percentile bootstrap band of the mean
};

/// What a treatment's populations are like at one generation, means over its finished runs: a row of population.csv.
struct PopulationRow {
    std::string treatment;
    int generation = 0;   ///< 0, 1, 2, 5, 10, 20, 50 and so on, and the last
    int runs = 0;
    double mean_reward = 0;               ///< of the survivors
    double fronts = 0;                    ///< of the joint ranking
    double tied = 0;                      ///< survivors that share all objectives with another
    double best_shaping = 0;              ///< [reward unit]; -1 without a knowledge base
    double shaping_at_max = 0;            ///< share of the survivors that have it
    double connections = 0, hidden = 0;   ///< of the survivors' networks
};

/// A knowledge base: a row of kbs.csv.
struct KnowledgeRow {
    std::string knowledge;
    std::string kind;   ///< "lineage", "all", "random", "reduced"
    int source_run = 0;
    std::uint64_t seed = 0;          ///< of that run
    double reward = 0;               ///< of its best-of-run
    std::uint64_t individuals = 0;   ///< whose windows were read: the lineage's length
    std::uint64_t windows = 0;
    int features = 0;
    double least_value = 0, greatest_value = 0;
    int at_greatest = 0;   ///< features of that value
    int shown_once = 0;    ///< features that one individual alone has shown
};

/// What the matrix of transfer says where the source's channels are not the target's.
inline constexpr char misfit_word[] = "other channels";

/// A field of the matrix of transfer.
struct FieldName {
    std::string source, target;   ///< names of tasks
};

/// All that the report shows. It is made from these rows alone, so that it can be made again from the CSV files long
/// after the runs are gone.
struct Results {
    std::vector<RunRow> runs;
    std::vector<CurveRow> curves;
    std::vector<PopulationRow> populations;
    std::vector<KnowledgeRow> bases;
    std::vector<SpeedRow> speeds;   ///< of the target treatments that have runs
    std::vector<LeadRow> leads;
    std::vector<Replay> replays;
    std::vector<PanelValues> panels;
    std::vector<FieldName> misfits;   ///< as matrix.csv of a former report has them

    std::vector<double> final_rewards(std::string_view treatment) const;
    /// Of the curves of that treatment, or of all if none is named; 0 without curves.
    int last_generation(std::string_view treatment = "") const;
    /// The unit of that treatment's runs; nothing if it has none.
    std::optional<std::string> unit_of(std::string_view treatment) const;
    /// The unit of the first target task's rewards; of the source task's as long as there is no target run.
    std::string reward_unit(CampaignPlan const&) const;
    /// Whether the target treatments have rewards of different units.
    bool has_several_units(CampaignPlan const&) const;
    /// "balls" if all runs have that unit, else "reward": in the names of columns.
    std::string_view reward_word() const;
    /// Whether all rewards are whole and none is negative: then something is counted.
    bool are_counts() const;
};

/// Gathers the finished runs and knowledge bases of a campaign from its directory; replays and panels stay empty.
/// Throws Error for a damaged file.
Results collect_results(CampaignPlan const&, CampaignDirectory const&);

/// The knowledge base from a lineage that this one goes back to.
KnowledgePlan const& origin_of(CampaignPlan const&, KnowledgePlan const&);

/// final.csv, runs.csv, curves.csv, population.csv, kbs.csv, speed.csv, leads.csv (docs/manual/formats.md).
void write_results(CampaignDirectory const&, Results const&);
/// Reads these and the files of the step "replay". curves.csv and final.csv or runs.csv must be there; parts of Results
/// whose file is missing stay empty. Throws Error.
Results read_results(CampaignDirectory const&);

}   // namespace lore
