#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/state.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace lore::campaign_program {

namespace {

void status_options(CLI::App& app, Arguments& arguments) { add_campaign(app, arguments); }

ExitCode show_status(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    CampaignDirectory const directory{arguments.directory};
    std::map<StepStatus, int> counts;
    std::set<std::string> unfinished;   // groups; every step comes after those that it waits for
    for (Step const& step : steps_of(campaign)) {
        StepState state = state_of(campaign, directory, step);
        ++counts[state.status];
        if (state.status != StepStatus::done) unfinished.insert(step.group);
        if (state.status == StepStatus::missing) {
            auto const open = std::find_if(step.after.begin(), step.after.end(),
                                           [&](std::string const& group) { return unfinished.contains(group); });
            if (open != step.after.end()) state.reason = fmt::format("waits for {}", *open);
            else if (state.reason.empty()) state.reason = "not started";
        }
        if (!arguments.quiet) fmt::print("{:<24} {:<12} {}\n", step.name, name(state.status), state.reason);
    }
    std::vector<std::string> words;
    for (auto const& [status, count] : counts) words.push_back(fmt::format("{} {}", count, name(status)));
    fmt::print("{}\n", fmt::join(words, ", "));
    return ExitCode::done;
}

}   // namespace

Subcommand const status{"status", "done / running / interrupted / failed / missing, with the reason", status_options,
                        show_status};

}   // namespace lore::campaign_program
