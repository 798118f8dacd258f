#pragma once

#include <lore/knowledge/value.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Several runs that differ in their seeds alone: run k (1, 2, ...) has seed first_seed + k - 1.
struct Treatment {
    std::string name;                     ///< in paths, files and tables: letters, digits, '_' and '-'
    std::string label;                    ///< in figures
    std::string config;                   ///< path of its lore-evolve configuration, as the campaign's file gives it
    std::vector<std::string> overrides;   ///< "section.key=value", those for its generations and its base among them
    std::vector<std::string> knowledge;   ///< name of the knowledge base that shapes the reward; at most one
    std::vector<std::string> clone_of;    ///< names of the bases that founders are cloned from, in equal shares
    std::vector<std::string> policy_of;   ///< names of the knowledge bases from whose source runs' last populations
                                          ///< founders come, in equal shares: the usual baseline of transfer
    int runs = 30;
    std::uint64_t first_seed = 1;
    std::string target;   ///< name of its target task, where the campaign's file names tasks; else empty
};

enum class KnowledgeKind : std::uint8_t {
    lineage,        ///< Algorithm 1 over the lineage of a source run's best
    same_lineage,   ///< over that of `base` once more, with other options
    all,            ///< over all individuals evaluated in the source run of `base`
    random,         ///< `base` with drawn values
    permuted,       ///< `base` with its values shuffled among the features
    revalued,       ///< `base` with values by another rule
    reduced         ///< a part of `base`
};

/// Bases that one table [[knowledge]] stands for: one of each run of a source (`run = "each"`), or one from each base
/// of another family.
struct KnowledgeFamily {
    std::string name;
    std::vector<std::string> members;   ///< NAME1, NAME2, ...: by source run
};

/// A knowledge base to be made.
struct KnowledgePlan {
    std::string name;
    std::string label;
    KnowledgeKind kind = KnowledgeKind::lineage;
    std::string source = "source";      ///< name of the source task whose runs it comes from
    double wished_reward = 0;           ///< lineage: the level wished of the source run's best-of-run [reward unit]
    int run = 0;                        ///< lineage: this source run, whatever its reward; 0: choose by reward
    bool best_run = false;              ///< lineage: choose the most reward, not the nearest to `wished_reward`
    std::string base;                   ///< all but lineage: the knowledge base it starts from
    std::uint64_t seed = 1;             ///< random, permuted: of the draw
    std::optional<int> window_length;   ///< of its windows [steps]; without: the source runs'
    std::optional<double> match_threshold;   ///< of its matches [L2]; without: the source runs'
    std::vector<double> gammas;   ///< of a base that is built: discounts of the returns it gathers, increasing;
                                  ///< without: those of lore-kb
    std::optional<double> success_reward;   ///< all: what makes a success [reward unit]; none: as lore-kb decides
    ValueConfig value;                      ///< revalued: by this rule
    std::vector<std::string> consensus;     ///< reduced: the knowledge bases that must know a feature too
    std::vector<std::string> options;       ///< further arguments of lore-kb build or reduce
};

/// What the figures show: treatments and pools (paper, figures 3 and 4), knowledge bases (figures 5 and 6).
struct FigurePlan {
    std::vector<std::string> figure3;   ///< names of treatments and pools, each once; empty: all treatments
    std::string trajectory;             ///< the knowledge base whose source run's best is shown; empty: no pictures
    std::vector<std::string> figure5;   ///< one panel each
    std::vector<std::string> figure6;   ///< the product of all of these
};

/// Target treatments whose runs are taken together: variants of one kind, such as clones of several bases.
struct PoolPlan {
    std::string name;
    std::string label;
    std::vector<std::string> treatments;
    std::vector<std::string> against;   ///< treatments, or pools before it, that it was planned to be compared with
};

/// One field of the matrix of transfer: runs on a target task with knowledge of a source task, beside runs without.
struct TransferPair {
    std::string source;      ///< name of a source task
    std::string target;      ///< name of a target task
    std::string treatment;   ///< with knowledge of the source; empty where it does not fit
    std::string none;        ///< the treatment of the same task without knowledge
    std::string misfit;      ///< why the source's knowledge does not fit the target; empty: it does, or that is not
                             ///< known, because a world could not be opened
};

/// How the campaign asks a batch system for its share.
struct ClusterPlan {
    std::string time_limit = "04:00:00";   ///< of a task; one that needs longer is queued again at a checkpoint
    int warning_seconds = 120;             ///< the task is told so long before its limit
    int concurrent = 100;                  ///< most tasks of one array at a time
    std::vector<std::string> options;      ///< further #SBATCH options
};

/// A campaign: runs on source tasks, knowledge bases from some of them, runs on target tasks with and without. Data, so
/// that another campaign needs only another file.
struct CampaignPlan {
    std::string path;        ///< of its file
    std::string directory;   ///< in which the file lies; relative paths start there
    std::string title;
    std::vector<Treatment> sources;          ///< the runs on each source task; one called "source" where there is one
    std::vector<KnowledgePlan> knowledge;    ///< each after those it is made from
    std::vector<KnowledgeFamily> families;   ///< of these; names that treatments take are those of members
    std::vector<Treatment> tasks;            ///< target tasks by name, and what treatments of each have in common
    std::vector<TransferPair> transfer;      ///< all source tasks by all target tasks, row by row; empty: no matrix
    std::vector<Treatment> targets;          ///< in the order in which they are run
    std::vector<PoolPlan> pools;
    std::vector<std::string> report_order;   ///< names of the targets, in the order of tables and figures
    std::vector<double> levels;   ///< of the reward, whose first reaching is timed; empty: as the report chooses
    FigurePlan figures;
    ClusterPlan cluster;

    bool is_source(std::string_view treatment) const;
    Treatment const& treatment(std::string_view name) const;            ///< precondition: there is one
    Treatment const& task(std::string_view name) const;                 ///< precondition: there is one
    KnowledgePlan const& knowledge_base(std::string_view name) const;   ///< precondition: there is one
    /// Of all bases and families: no two are the same.
    std::vector<std::string> base_names() const;
    /// The same names with the members of a family in the place of its own.
    std::vector<std::string> members(std::vector<std::string> const& names) const;
    PoolPlan const* pool(std::string_view name) const;       ///< null if there is none
    std::string const& label(std::string_view name) const;   ///< of a treatment or a pool
    std::string config_path(Treatment const&) const;         ///< usable from the working directory
};

/// The base by Algorithm 1 that a base is, or was derived from: its features and its evidence.
KnowledgePlan const& built_base(CampaignPlan const&, KnowledgePlan const&);

/// Names of the source tasks' treatments, then of the target treatments in the report's order.
std::vector<std::string> all_treatments(CampaignPlan const&);
/// Runs of all of them.
int planned_runs(CampaignPlan const&);

/// Target treatments whose rewards can be compared, in the report's order.
struct TaskGroup {
    std::string task;   ///< name of their target task; empty where the file names none
    std::vector<std::string> treatments;
};
/// One group a target task that has treatments, after the group of those without a named task.
std::vector<TaskGroup> task_groups(CampaignPlan const&);

/// Reads jobs/campaigns/paper.toml and its like. Every treatment's configuration is read too, with its overrides.
/// A treatment reads windows of the length and with the threshold of its knowledge base, without having to say so. A
/// base gathers the evidence that the bases revalued from it need. Throws UsageError: syntax, unknown key, a name used
/// twice or not defined, a value out of range, a treatment that sets other windows than its base has, a value rule
/// whose evidence no build of such a base gathers.
///
/// A table [transfer] adds, for each target task, a treatment without knowledge, and for each source task whose world
/// has the same channels one with it, and the knowledge bases for these. Only for that, worlds are opened.
CampaignPlan read_campaign(std::string const& path);

}   // namespace lore
