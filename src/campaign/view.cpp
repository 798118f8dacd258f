#include "view.h"

#include <lore/campaign/board.h>
#include <lore/campaign/time_left.h>
#include <lore/core/column.h>
#include <lore/core/progress.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>

namespace lore {

namespace {

/// Of all runs together.
double work_left(std::vector<Task> const& tasks) {
    std::vector<RunPace> runs;
    for (Task const& task : tasks) {
        if (!is_run(task.step)) continue;
        bool const ended = task.phase == Phase::done || task.phase == Phase::failed || task.phase == Phase::blocked;
        runs.push_back({task.step.group, task.generation, task.generations, task.seconds, !ended});
    }
    return work_left(runs);
}

/// As wide for 1 as for other whole numbers.
std::string best_text(Task const& task) {
    std::string const best = reward_text(task.best_reward, task.reward_unit);
    return fmt::format("{:<{}} ", best, reward_text(task.best_reward).size() + 1 + task.reward_unit.size());
}

std::string run_line(Task const& task, std::size_t width) {
    double const left = task.generation > 0 ? task.seconds / task.generation * (task.generations - task.generation) : 0;
    return fmt::format("  {:<{}} {} {:>6}/{}  best {}{}", task.step.name, width,
                       bar(static_cast<double>(task.generation) / task.generations, 20), task.generation,
                       task.generations, best_text(task), left > 0 ? fmt::format(" {} left", duration_text(left)) : "");
}

}   // namespace

std::vector<std::string> step_lines(std::vector<Task> const& tasks) {
    std::vector<std::string> lines;
    std::size_t const width = column_width(22, tasks, [](Task const& task) { return task.step.name; });
    for (Task const& task : tasks) {
        if (task.phase != Phase::working) continue;
        bool const has_bar = is_run(task.step) && task.generations > 0;
        lines.push_back(has_bar ? run_line(task, width) : fmt::format("  {:<{}} at work", task.step.name, width));
    }
    return lines;
}

std::string overall_line(std::vector<Task> const& tasks, int jobs) {
    double const left = work_left(tasks) / jobs;
    int const done = count(tasks, Phase::done);
    return fmt::format("{} {} of {} steps done, {} running, {} failed{}",
                       bar(done / static_cast<double>(tasks.size()), 20), done, tasks.size(),
                       count(tasks, Phase::working) + count(tasks, Phase::elsewhere),
                       count(tasks, Phase::failed) + count(tasks, Phase::blocked),
                       left > 0 ? fmt::format(", about {} left", duration_text(left)) : "");
}

std::string summary_line(std::vector<Task> const& tasks) {
    int const failed = count(tasks, Phase::failed), blocked = count(tasks, Phase::blocked);
    return fmt::format("{} of {} steps done{}{}{}", count(tasks, Phase::done), tasks.size(),
                       failed > 0 ? fmt::format(", {} failed", failed) : "",
                       blocked > 0 ? fmt::format(", {} wait for those", blocked) : "",
                       unfinished(tasks) > 0 ? "; run it again to go on" : "");
}

std::string started_line(Task const& task) {
    if (task.generation == 0) return fmt::format("{} started", task.step.name);
    return fmt::format("{} resumed at generation {} of {}", task.step.name, task.generation, task.generations);
}

}   // namespace lore
