#include "subcommand.h"

#include <lore/campaign/choice.h>
#include <lore/campaign/plan.h>
#include <lore/campaign/state.h>
#include <lore/campaign/worlds.h>
#include <lore/core/column.h>

#include <fmt/ranges.h>

#include <algorithm>

namespace lore::campaign_program {

namespace {

std::string waits_for(Step const& step) {
    return step.after.empty() ? "-" : fmt::format("{}", fmt::join(step.after, ","));
}

void plan_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    add_launcher(app, arguments);
}

ExitCode print_plan(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    check_worlds(campaign);
    CampaignDirectory const directory{arguments.directory};
    auto const choice = recorded_choices(campaign, directory);
    std::vector<Step> const steps = steps_of(campaign);
    std::size_t const names = column_width(24, steps, [](Step const& step) { return step.name; });
    // A step that waits for many does not push the commands of the others out of sight.
    std::size_t const waits = std::min<std::size_t>(40, column_width(22, steps, waits_for));
    fmt::print("# {}\n{:<{}} {:<{}} {}\n", campaign.title, "step", names, "waits for", waits, "command");
    for (Step const& step : steps) {
        auto const command =
            command_of(campaign, directory, arguments.runner.launcher, step, choice ? &*choice : nullptr);
        fmt::print("{:<{}} {:<{}} {}\n", step.name, names, waits_for(step), waits,
                   command.empty() ? "(source runs for the knowledge bases)" : shell_text(command));
    }
    for (TransferPair const& pair : campaign.transfer)
        if (!pair.misfit.empty())
            fmt::print("# not run: {} with knowledge of {} ({})\n", pair.target, pair.source, pair.misfit);
    return ExitCode::done;
}

}   // namespace

Subcommand const plan{"plan", "list the steps, what each waits for, and its command", plan_options, print_plan};

}   // namespace lore::campaign_program
