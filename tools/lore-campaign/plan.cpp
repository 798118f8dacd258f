#include "subcommand.h"

#include <lore/campaign/choice.h>
#include <lore/campaign/plan.h>
#include <lore/campaign/state.h>
#include <lore/campaign/worlds.h>

#include <fmt/ranges.h>

namespace lore::campaign_program {

namespace {

void plan_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    add_launcher(app, arguments);
}

ExitCode print_plan(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    check_worlds(campaign);
    CampaignDirectory const directory{arguments.directory};
    auto const choice = recorded_choices(campaign, directory);
    fmt::print("# {}\n{:<24} {:<22} {}\n", campaign.title, "step", "waits for", "command");
    for (Step const& step : steps_of(campaign)) {
        auto const command =
            command_of(campaign, directory, arguments.runner.launcher, step, choice ? &*choice : nullptr);
        fmt::print("{:<24} {:<22} {}\n", step.name,
                   step.after.empty() ? "-" : fmt::format("{}", fmt::join(step.after, ",")),
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
