#include "task_parts.h"

#include <algorithm>

#include <fmt/format.h>

namespace lore {

namespace {

/// Keeps the rows of these treatments.
template <class Row>
std::vector<Row> rows_of(std::vector<Row> const& rows, std::vector<std::string> const& treatments) {
    std::vector<Row> kept;
    for (Row const& row : rows)
        if (std::find(treatments.begin(), treatments.end(), row.treatment) != treatments.end()) kept.push_back(row);
    return kept;
}

TaskPart part_of(TaskGroup const& group, CampaignPlan const& plan, Results const& results,
                 std::vector<Comparison> const& comparisons) {
    TaskPart part{group.task, "", plan, {}, {}};
    part.plan.report_order = group.treatments;
    if (!group.task.empty()) {
        part.label = plan.task(group.task).label;
        part.plan.sources.clear();
        std::string const before = part.label + ": ";
        for (Treatment& treatment : part.plan.targets)
            if (treatment.label.starts_with(before)) treatment.label.erase(0, before.size());
    }
    std::vector<std::string> const shown = all_treatments(part.plan);
    part.results.runs = rows_of(results.runs, shown);
    part.results.speeds = rows_of(results.speeds, shown);
    auto const has = [&](std::string const& name) {
        return std::find(shown.begin(), shown.end(), name) != shown.end();
    };
    std::vector<std::string> with_pools = shown;
    for (PoolPlan const& pool : plan.pools)
        if (has(pool.treatments.front())) with_pools.push_back(pool.name);
    part.results.curves = rows_of(results.curves, with_pools);
    for (Comparison const& one : comparisons)
        if (has(one.a) && has(one.b)) part.comparisons.push_back(one);
    return part;
}

}   // namespace

std::string TaskPart::figure(std::string_view name) const {
    return task.empty() ? std::string{name} : fmt::format("{}_{}", name, task);
}

std::vector<TaskPart> task_parts(CampaignPlan const& plan, Results const& results,
                                 std::vector<Comparison> const& comparisons) {
    std::vector<TaskPart> parts;
    for (TaskGroup const& group : task_groups(plan)) parts.push_back(part_of(group, plan, results, comparisons));
    return parts;
}

}   // namespace lore
