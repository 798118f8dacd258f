#pragma once

#include "comparison.h"
#include "results.h"

#include <string>
#include <vector>

namespace lore {

/// What a campaign has found about one target task: its treatments with their runs, as figures 3 and 4 show them.
struct TaskPart {
    std::string task;    ///< its name; empty where the campaign's file names none
    std::string label;   ///< of the task
    CampaignPlan
        plan;          ///< these treatments alone; of a named task without sources, and with labels without the task's
    Results results;   ///< of these treatments; without replays
    std::vector<Comparison> comparisons;
    /// "figure3" of a campaign that names no task, else "figure3_NAME".
    std::string figure(std::string_view name) const;
};

/// One a target task, in the order of task_groups; the whole campaign where its file names none.
std::vector<TaskPart> task_parts(CampaignPlan const&, Results const&, std::vector<Comparison> const&);

}   // namespace lore
