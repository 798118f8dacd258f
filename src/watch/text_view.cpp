#include <lore/watch/text_view.h>

#include <lore/campaign/board.h>
#include <lore/core/column.h>
#include <lore/core/progress.h>
#include <lore/core/utf8.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace lore {

namespace {

/// Of a line's first column: as wide for treatments as for steps.
std::size_t name_width(CampaignFacts const& facts) {
    std::size_t const of_steps = column_width(22, facts.steps, [](StepWithState const& one) { return one.step.name; });
    return column_width(of_steps, facts.treatments, [](TreatmentFacts const& treatment) { return treatment.name; });
}

std::string run_line(Step const& step, StepState const& state, std::size_t width) {
    if (state.generations == 0) return fmt::format("  {:<{}} at work", step.name, width);
    double const share = static_cast<double>(state.generation) / state.generations;
    double const left = state.generation > 0 ? state.seconds / share - state.seconds : 0;
    return fmt::format("  {:<{}} {} {:>6}/{}  best {}{}", step.name, width, bar(share, 20), state.generation,
                       state.generations, reward_text(state.best_reward, state.reward_unit),
                       left > 0 ? fmt::format("  {} left", duration_text(left)) : "");
}

/// Of counts with two decimals.
std::string mean_text(TreatmentFacts const& facts) {
    return facts.reward_unit == first_reward_unit ? fmt::format("{:.2f}", facts.mean_reward)
                                                  : reward_text(facts.mean_reward);
}

std::string treatment_line(TreatmentFacts const& facts, std::size_t width) {
    std::string line = fmt::format("  {:<{}} {:>4} of {:<4} done", facts.name, width, facts.done, facts.planned);
    if (facts.started > 0)
        line += fmt::format("  mean {}, best {}", mean_text(facts), reward_text(facts.best_reward, facts.reward_unit));
    if (facts.failed > 0) line += fmt::format("  {} failed", facts.failed);
    return line;
}

}   // namespace

std::string summary_of(CampaignFacts const& facts) {
    std::string line = fmt::format("{} {} of {} steps done, {} running, {} failed", bar(facts.share, 10),
                                   facts.count(StepStatus::done), facts.steps.size(), facts.count(StepStatus::running),
                                   facts.count(StepStatus::failed));
    if (facts.seconds_left) line += fmt::format(", about {} left", duration_text(*facts.seconds_left));
    return line;
}

std::vector<std::string> picture_of(CampaignFacts const& facts) {
    std::vector<std::string> lines{harmless(facts.title)};
    std::size_t const width = name_width(facts);
    for (TreatmentFacts const& treatment : facts.treatments) lines.push_back(treatment_line(treatment, width));
    for (auto const& [step, state] : facts.steps)
        if (state.status == StepStatus::running) lines.push_back(run_line(step, state, width));
    for (FailureFacts const& failure : facts.failures) {
        lines.push_back(harmless(fmt::format("  {} failed: {}", failure.step, failure.reason)));
        if (!failure.tail.empty()) lines.push_back(harmless(fmt::format("      {}", failure.log)));
        for (std::string const& line : failure.tail) lines.push_back(harmless(fmt::format("      {}", line)));
    }
    if (!facts.notice.empty()) lines.push_back(harmless(facts.notice));
    lines.push_back(summary_of(facts));
    return lines;
}

std::vector<std::string> changes_between(CampaignFacts const& before, CampaignFacts const& now) {
    std::vector<std::string> lines;
    auto const say = [&](std::string_view what) { lines.push_back(harmless(fmt::format("{} {}", now.time, what))); };
    if (now.notice != before.notice && !now.notice.empty()) say(now.notice);
    std::map<std::string, StepStatus> former;
    for (auto const& [step, state] : before.steps) former[step.name] = state.status;
    for (auto const& [step, state] : now.steps) {
        auto const known = former.find(step.name);
        StepStatus const was = known == former.end() ? StepStatus::missing : known->second;
        if (state.status != was)
            say(fmt::format("{} {}{}{}", step.name, name(state.status), state.reason.empty() ? "" : ": ",
                            state.reason));
    }
    return lines;
}

}   // namespace lore
