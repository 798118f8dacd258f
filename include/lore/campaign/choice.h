#pragma once

#include <lore/campaign/plan.h>
#include <lore/world/reward_text.h>

#include <string>
#include <vector>

namespace lore {

/// How a finished source run ended.
struct SourceRun {
    int run = 0;
    std::uint64_t seed = 0;
    double reward = 0;   ///< of its best-of-run
};

/// The source run that a knowledge base comes from.
struct ChosenRun {
    std::string knowledge;
    double wished = 0;   ///< level wished [reward unit]; meaningless where the campaign names the run
    int run = 0;
    std::uint64_t seed = 0;
    double reward = 0;
    bool best = false;   ///< most reward was wished, not a level
};

/// Which source runs the knowledge bases come from. What is recorded stays, so that runs added later change nothing.
struct Choice {
    std::vector<ChosenRun> chosen;
    std::vector<SourceRun> considered;   ///< all finished source runs
    std::vector<int> without;            ///< source runs that had failed
    std::string reward_unit{first_reward_unit};
    std::string source = "source";   ///< whose runs these are; empty: the choices from several sources together

    /// Null if nothing was chosen for this knowledge base yet.
    ChosenRun const* find(std::string_view knowledge) const;
    /// Precondition: it was chosen.
    ChosenRun const& of(std::string_view knowledge) const;
    /// Whether every knowledge base made from a lineage of this source has its run.
    bool covers(CampaignPlan const&) const;
    /// The first base for which the campaign asks for another run, level or rule now than when its run was chosen; null
    /// if there is none.
    ChosenRun const* outdated(CampaignPlan const&) const;
};

/// The rule. Runs named by the campaign are taken first; then, in the order of the campaign's file, each knowledge
/// base gets the run whose best-of-run is nearest to the level wished, or has most reward, among those not yet taken;
/// ties: the lowest seed.
///
/// `before` says the source. What it has chosen is kept, and its unit. Throws Error: too few runs, or a named run is
/// not among them.
Choice choose_runs(CampaignPlan const&, std::vector<SourceRun> const& finished, std::vector<int> without,
                   Choice const& before = {});

void write_choice(std::string const& path, Choice const&);
Choice read_choice(std::string const& path);

}   // namespace lore
